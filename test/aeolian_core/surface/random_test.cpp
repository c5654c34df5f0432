#include "aeolian_core/surface/random.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr std::size_t count = 200000;

template <class Draw>
std::vector<double> drawn(Draw draw) {
  RandomStream random(7, 3);
  std::vector<double> values(count);
  for (double& value : values) value = draw(random);
  return values;
}

/// Largest distance between the sample's and the exact distribution, in units of 1 / sqrt(count): above 1.95
/// once in a thousand samples of a right generator (Kolmogorov).
template <class Distribution>
double kolmogorov(std::vector<double> values, Distribution exact) {
  std::sort(values.begin(), values.end());
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double share = exact(values[i]);
    const auto n = static_cast<double>(values.size());
    largest = std::max({largest, share - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - share});
  }
  return largest * std::sqrt(static_cast<double>(values.size()));
}

double mean(const std::vector<double>& values, int power) {
  double sum = 0;
  for (const double value : values) sum += std::pow(value, power);
  return sum / static_cast<double>(values.size());
}

/// Five standard errors of a mean of `count` numbers of the given variance.
double five_sigma(double variance) { return 5 * std::sqrt(variance / static_cast<double>(count)); }

// Known-answer vectors of Random123 (kat_vectors, philox 4x32 10).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(Philox(0)(0, 0), (Philox::Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint64_t ones = ~std::uint64_t{0};
  EXPECT_EQ(Philox(ones)(ones, ones), (Philox::Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox(0x299f31d0a4093822)(0x85a308d3243f6a88, 0x0370734413198a2e),
            (Philox::Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, DrawsTheWordsOfItsGeneratorInOrder) {
  RandomStream random(11, 5);
  for (std::uint64_t counter = 0; counter < 3; ++counter)
    for (const std::uint32_t word : Philox(11)(counter, 5)) EXPECT_EQ(random.bits(), word);
}

TEST(RandomStream, UniformFillsTheOpenInterval) {
  const auto values = drawn([](RandomStream& r) { return r.uniform(); });
  EXPECT_GT(*std::min_element(values.begin(), values.end()), 0);
  EXPECT_LT(*std::max_element(values.begin(), values.end()), 1);
  EXPECT_NEAR(mean(values, 1), 0.5, five_sigma(1.0 / 12));
  EXPECT_NEAR(mean(values, 2), 1.0 / 3, five_sigma(4.0 / 45));
  EXPECT_LT(kolmogorov(values, [](double x) { return x; }), 1.95);
}

TEST(RandomStream, NormalHasTheMomentsAndTheDistribution) {
  const auto values = drawn([](RandomStream& r) { return r.normal(); });
  EXPECT_NEAR(mean(values, 1), 0, five_sigma(1));
  EXPECT_NEAR(mean(values, 2), 1, five_sigma(2));
  EXPECT_NEAR(mean(values, 3), 0, five_sigma(15));
  EXPECT_NEAR(mean(values, 4), 3, five_sigma(96));
  EXPECT_LT(kolmogorov(values, [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }), 1.95);
}

TEST(RandomStream, ExponentialHasTheMomentsAndTheDistribution) {
  const auto values = drawn([](RandomStream& r) { return r.exponential(); });
  EXPECT_NEAR(mean(values, 1), 1, five_sigma(1));
  EXPECT_NEAR(mean(values, 2), 2, five_sigma(20));
  EXPECT_LT(kolmogorov(values, [](double x) { return -std::expm1(-x); }), 1.95);
}

TEST(RandomStream, StreamsAndSeedsAreUncorrelated) {
  const auto correlation = [](RandomStream a, RandomStream b) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
    return sum / static_cast<double>(count);
  };
  EXPECT_NEAR(correlation({7, 0}, {7, 1}), 0, five_sigma(1.0 / 144));
  EXPECT_NEAR(correlation({7, 0}, {8, 0}), 0, five_sigma(1.0 / 144));
}

}  // namespace
}  // namespace aeolian
