#include "aeolian_rviz/horizon_choice.hpp"

#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// Horizons of 30 s and 5 min from the surface at 2023-11-14 22:13:20 UTC.
HorizonChoice two_horizons(double chosen, const ros::Time& start = ros::Time(1700000000)) {
  aeolian_msgs::ForecastHorizons horizons;
  horizons.lead_times = {30, 300};
  for (const double lead : horizons.lead_times) horizons.valid.push_back(start + ros::Duration(lead));
  horizons.chosen = chosen;
  HorizonChoice choice;
  choice.take(horizons);
  return choice;
}

TEST(HorizonChoice, SaysThatThereIsNoForecast) {
  const HorizonChoice none;
  EXPECT_EQ(none.last(), 0);
  EXPECT_EQ(none.chosen(), 0);
  EXPECT_EQ(none.title(0), "No forecast yet");
  EXPECT_EQ(none.times(0), "");
  EXPECT_EQ(none.lead_time(7), 0);
}

TEST(HorizonChoice, GoesFromMeasuredNowToTheLongestLeadTime) {
  const HorizonChoice choice = two_horizons(300);
  EXPECT_EQ(choice.last(), 2);
  EXPECT_EQ(choice.chosen(), 2);
  EXPECT_EQ(choice.mark(0), "now");
  EXPECT_EQ(choice.mark(1), "30 s");
  EXPECT_EQ(choice.lead_time(0), 0);
  EXPECT_EQ(choice.lead_time(2), 300);
  EXPECT_EQ(choice.title(0), "Measured now");
  EXPECT_EQ(choice.title(2), "Predicted 5 min ahead");
  EXPECT_EQ(choice.times(2), "for 22:18:20 UTC, from the surface at 22:13:20 UTC");
}

TEST(HorizonChoice, FollowsWhatIsShown) {
  EXPECT_EQ(two_horizons(0).chosen(), 0);
  EXPECT_EQ(two_horizons(30).chosen(), 1);
}

TEST(HorizonChoice, SimulatedClocksHaveNoTimeOfDay) {
  EXPECT_EQ(two_horizons(30, ros::Time(12.5)).times(1), "for 42.5 s, from the surface at 12.5 s");
}

}  // namespace
}  // namespace aeolian
