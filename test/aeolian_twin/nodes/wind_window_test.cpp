#include "aeolian_twin/nodes/wind_window.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/wind/gusts.hpp"

namespace aeolian {
namespace {

TEST(WindWindow, TheMeanIsThatOfTheTimeAskedFor) {
  WindWindow window(100);
  for (int t = 0; t < 10; ++t) window.add(t, {t, -2.0 * t});
  EXPECT_EQ(window.mean(0), Eigen::Vector2d(9, -18)) << "the reading itself";
  EXPECT_EQ(window.mean(3), Eigen::Vector2d(8, -16)) << "7, 8 and 9 s";
  EXPECT_EQ(window.mean(1e9), Eigen::Vector2d(4.5, -9));
}

TEST(WindWindow, ForgetsWhatIsOldAndBeginsAnewWhenTimeJumpsBack) {
  WindWindow window(5);
  for (int t = 0; t < 20; ++t) window.add(t, {t, 0});
  EXPECT_EQ(window.statistics().readings, 6U);
  EXPECT_EQ(window.statistics().duration, 5);
  window.add(3, {7, 0});
  EXPECT_EQ(window.statistics().readings, 1U);
  EXPECT_EQ(window.mean(100), Eigen::Vector2d(7, 0));
}

TEST(WindWindow, AStepOfWindHasTheGustAndDeviationOfItsDefinition) {
  WindWindow window(600);
  // Half a minute of 6 m/s, 3 s of 12, half a minute of 6, at 10 Hz, to the north-west.
  const Eigen::Vector2d to(-std::sqrt(0.5), std::sqrt(0.5));
  for (int i = 0; i < 630; ++i) window.add(0.1 * i, (i >= 300 && i < 330 ? 12 : 6) * to);
  const GustStatistics s = window.statistics();
  const double mean = (600 * 6 + 30 * 12) / 630.0;
  EXPECT_NEAR(s.speed, mean, 1e-12);
  EXPECT_NEAR(s.direction, 0.75 * M_PI, 1e-12);
  EXPECT_NEAR(s.gust, 12, 0.2);
  EXPECT_NEAR(s.gust_ratio, s.gust / mean, 1e-12);
  const double part = 30 / 630.0;
  EXPECT_NEAR(s.deviation_along, 6 * std::sqrt(part * (1 - part) * 630 / 629), 1e-9);
  EXPECT_NEAR(s.deviation_across, 0, 1e-9);
  EXPECT_NEAR(s.turbulence_intensity, s.deviation_along / mean, 1e-12);
}

TEST(WindWindow, KaimalsGustsHaveTheirDeviations) {
  // 2.18 and 1.64 u* (Kaimal et al. 1972) but for what is slower than the record and faster than its step.
  const Gusts gusts = synthetic_gusts({8, 10, 0.4, 0.1, 12000}, 5);
  WindWindow window(2000);
  for (std::size_t i = 0; i < gusts.along.size(); ++i)
    window.add(0.1 * static_cast<double>(i), {8 + gusts.along[i], gusts.across[i]});
  const GustStatistics s = window.statistics();
  EXPECT_NEAR(s.deviation_along, 2.18 * 0.4, 0.06);
  EXPECT_NEAR(s.deviation_across, 1.64 * 0.4, 0.06);
  EXPECT_NEAR(s.turbulence_intensity, 2.18 * 0.4 / 8, 0.008);
  EXPECT_GT(s.gust_ratio, 1.2) << "of 3 s within 20 minutes, over open ground 1.3 to 1.5";
  EXPECT_LT(s.gust_ratio, 1.5);
}

TEST(WindWindow, FewReadingsTellNoDeviation) {
  WindWindow window(10);
  EXPECT_EQ(window.statistics().readings, 0U);
  EXPECT_TRUE(std::isnan(window.statistics().speed));
  window.add(0, {3, 4});
  EXPECT_EQ(window.statistics().speed, 5);
  EXPECT_EQ(window.statistics().gust, 5);
  EXPECT_TRUE(std::isnan(window.statistics().deviation_along));
  WindWindow calm(10);
  calm.add(0, {0, 0});
  calm.add(1, {0, 0});
  EXPECT_EQ(calm.statistics().speed, 0);
  EXPECT_TRUE(std::isnan(calm.statistics().gust_ratio));
}

}  // namespace
}  // namespace aeolian
