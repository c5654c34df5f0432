// The tables in config/splash/tables are what their heads say and what sand does.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "aeolian_core/grains/splash/splash_table.hpp"

namespace aeolian {
namespace {

class ShippedTable : public testing::TestWithParam<std::string> {
 protected:
  ShippedTable()
      : table_(SplashTable::read(std::string(AEOLIAN_REPOSITORY) + "/config/splash/tables/" + GetParam() +
                                 ".csv")) {}
  const SplashTable table_;
};

TEST_P(ShippedTable, TellsTheCommandThatMadeIt) {
  EXPECT_EQ(table_.source().command, "rosrun aeolian_twin splash_study --config config/splash/" + GetParam() +
                                         ".yaml --out " + GetParam());
  EXPECT_EQ(table_.source().ejecta_kept < 1, GetParam() == "coarse_sand");
}

TEST_P(ShippedTable, NumbersGrowWithSpeedAtEveryAngle) {
  for (const double angle : table_.axis(SplashTable::angle))
    for (const double roughness : table_.axis(SplashTable::roughness)) {
      const auto& speeds = table_.axis(SplashTable::speed);
      const double slow = table_.mean_number({speeds.front(), angle, 1, roughness});
      const double fast = table_.mean_number({speeds.back(), angle, 1, roughness});
      EXPECT_LT(slow, 2);
      EXPECT_GT(fast, 3);
    }
}

TEST_P(ShippedTable, ReboundsFallWithTheAngle) {
  double last = 1;
  for (const double angle : table_.axis(SplashTable::angle)) {
    RandomStream random(1, 0);
    double sum = 0;
    int rebounds = 0;
    for (int i = 0; i < 2000; ++i) {
      const auto event = table_.draw({90, angle, 1, 0.1}, random);
      if (event.captured) continue;
      sum += std::sqrt(event.along * event.along + event.across * event.across + event.away * event.away);
      ++rebounds;
    }
    EXPECT_LT(sum / rebounds, last);
    EXPECT_GT(rebounds, 1500);
    last = sum / rebounds;
  }
  EXPECT_LT(last, 0.45);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedTable, testing::Values("fine_sand", "coarse_sand", "snow"));

}  // namespace
}  // namespace aeolian
