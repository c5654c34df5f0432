#include "aeolian_core/measure/virtual_anemometer.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

// The effective number of independent samples of a first-order process is duration / (2 gust_time) for the
// mean and duration / gust_time for the variance.
TEST(VirtualAnemometer, HasItsStatistics) {
  VirtualAnemometer a;
  a.direction = 0.4;
  const double duration = 40000;
  const double rate = 10;
  const auto samples = a.record(duration, rate, 9);
  const auto n = static_cast<double>(samples.size());
  double speed = 0;
  double direction = 0;
  for (const auto& s : samples) {
    speed += s.speed / n;
    direction += s.direction / n;
  }
  double speed_variance = 0;
  double direction_variance = 0;
  double lagged = 0;
  const auto lag = static_cast<std::size_t>(a.gust_time * rate);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    speed_variance += std::pow(samples[i].speed - speed, 2) / n;
    direction_variance += std::pow(samples[i].direction - direction, 2) / n;
    if (i >= lag) lagged += (samples[i].speed - speed) * (samples[i - lag].speed - speed) / n;
  }
  const double sigma = a.gust_intensity * a.mean_speed;
  const double mean_error = std::sqrt(2 * a.gust_time / duration);
  const double std_error = std::sqrt(a.gust_time / (2 * duration));
  EXPECT_NEAR(speed, a.mean_speed, 4 * sigma * mean_error);
  EXPECT_NEAR(direction, a.direction, 4 * a.direction_sigma * mean_error);
  EXPECT_NEAR(std::sqrt(speed_variance), sigma, 4 * sigma * std_error);
  EXPECT_NEAR(std::sqrt(direction_variance), a.direction_sigma, 4 * a.direction_sigma * std_error);
  EXPECT_NEAR(lagged / speed_variance, std::exp(-1), 4 * mean_error);
}

TEST(VirtualAnemometer, SamplesAtItsRateBelowTheDuration) {
  const auto samples = VirtualAnemometer{}.record(2, 10, 1);
  ASSERT_EQ(samples.size(), 20U);
  EXPECT_EQ(samples.front().time, 0);
  EXPECT_NEAR(samples.back().time, 1.9, 1e-12);
  EXPECT_TRUE(VirtualAnemometer{}.record(0, 10, 1).empty());
  EXPECT_THROW(VirtualAnemometer{}.record(1, 0, 1), Error);
}

TEST(VirtualAnemometer, IsNeverNegativeAndStaysInTheCircle) {
  VirtualAnemometer a;
  a.gust_intensity = 1;
  a.direction = 3.1;
  a.direction_sigma = 0.5;
  for (const auto& s : a.record(1000, 10, 3)) {
    EXPECT_GE(s.speed, 0);
    EXPECT_LE(std::abs(s.direction), M_PI);
  }
}

TEST(VirtualAnemometer, IsDecidedByItsSeed) {
  const VirtualAnemometer a;
  EXPECT_EQ(a.record(1, 10, 1).back().speed, a.record(1, 10, 1).back().speed);
  EXPECT_NE(a.record(1, 10, 1).back().speed, a.record(1, 10, 2).back().speed);
}

}  // namespace
}  // namespace aeolian
