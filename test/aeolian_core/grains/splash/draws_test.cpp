#include "aeolian_core/grains/splash/draws.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr int count = 100000;

struct Moments {
  double mean, deviation;
};

template <typename Draw>
Moments moments(const Draw& draw) {
  RandomStream random(7, 1);
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double x = draw(random);
    sum += x;
    squares += x * x;
  }
  return {sum / count, std::sqrt(squares / count - sum * sum / count / count)};
}

TEST(DrawsTest, normal_numbers_are_normal) {
  RandomStream random(3, 1);
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(draw_normal(random));
  std::sort(all.begin(), all.end());
  double distance = 0;  // Kolmogorov and Smirnov
  for (int i = 0; i < count; ++i)
    distance = std::max(
        distance, std::abs(std::erfc(-all[static_cast<std::size_t>(i)] / M_SQRT2) / 2 - (i + 0.5) / count));
  EXPECT_LT(distance, 1.95 / std::sqrt(count));  // one in a thousand
  EXPECT_GT(all.back(), 3.6);                    // the tail beyond the ziggurat is there
}

TEST(DrawsTest, exponential_numbers_are_exponential) {
  RandomStream random(3, 1);
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(draw_exponential(random));
  std::sort(all.begin(), all.end());
  double distance = 0;
  for (int i = 0; i < count; ++i)
    distance =
        std::max(distance, std::abs(1 - std::exp(-all[static_cast<std::size_t>(i)]) - (i + 0.5) / count));
  EXPECT_LT(distance, 1.95 / std::sqrt(count));
  EXPECT_GT(all.back(), 8);  // beyond the ziggurat
}

TEST(DrawsTest, tails_are_those_of_the_normal_distribution) {
  for (const double low : {-1.0, 0.5, 2.0}) {
    const double share = std::erfc(low / M_SQRT2) / 2;
    const double mean = std::exp(-low * low / 2) / std::sqrt(2 * M_PI) / share;
    EXPECT_NEAR(moments([&](auto& r) { return draw_normal_above(low, r); }).mean, mean, 0.012) << low;
  }
}

TEST(DrawsTest, poisson_numbers_have_equal_mean_and_variance) {
  for (const double mean : {0.0, 0.3, 4.0, 90.0}) {
    const Moments found = moments([&](auto& r) { return draw_poisson(mean, r); });
    EXPECT_NEAR(found.mean, mean, 4 * std::sqrt(mean / count));
    EXPECT_NEAR(found.deviation, std::sqrt(mean), 0.02 * std::sqrt(mean));
  }
}

TEST(DrawsTest, rounded_numbers_have_the_mean_and_are_next_to_it) {
  const Moments found = moments([](auto& r) { return draw_rounded(2.3, r); });
  EXPECT_NEAR(found.mean, 2.3, 0.01);
  EXPECT_NEAR(found.deviation, std::sqrt(0.3 * 0.7), 0.01);
}

TEST(DrawsTest, cut_normal_has_its_moments_after_the_cut) {
  const TruncatedNormal cut(0.80, 0.43, 0, 3.7);
  const Moments found = moments([&](auto& r) { return cut.draw(r); });
  EXPECT_NEAR(found.mean, 0.80, 0.006);
  EXPECT_NEAR(found.deviation, 0.43, 0.006);
  EXPECT_THROW(TruncatedNormal(0.5, 0.5, 0, 1), Error);  // wider than even spread
}

TEST(DrawsTest, log_normal_has_its_own_moments) {
  const LogNormal speeds(48, 28);
  const Moments found = moments([&](auto& r) { return speeds.at(draw_normal(r)); });
  EXPECT_NEAR(found.mean, 48, 0.5);
  EXPECT_NEAR(found.deviation, 28, 1);
}

TEST(DrawsTest, counts_have_mean_and_deviation_on_both_sides_of_chance) {
  for (const auto& [mean, deviation] : {std::pair{2.8, 1.1}, {4.1, 2.6}, {5.0, 2.1}}) {
    const CountDistribution counts(mean, deviation);
    const Moments found = moments([&](auto& r) { return counts.draw(r); });
    EXPECT_NEAR(found.mean, mean, 0.03);
    EXPECT_NEAR(found.deviation, deviation, 0.03);
  }
}

}  // namespace
}  // namespace aeolian
