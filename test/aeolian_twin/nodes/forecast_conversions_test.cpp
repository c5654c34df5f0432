#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

aeolian_msgs::WindAhead wind_ahead() {
  aeolian_msgs::WindAhead message;
  message.header.stamp = ros::Time(1000, 500000000);
  message.lead_time = {0, 600};
  message.speed = {8, 10};
  message.direction = {0.1, -0.2};
  message.height = 2;
  return message;
}

TEST(WindAhead, SpeedsAtAHeightBecomeFrictionVelocities) {
  const auto samples = to_wind_samples(wind_ahead(), 1e-5);
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(samples[0].time, 1000.5);
  EXPECT_EQ(samples[1].time, 1600.5);
  EXPECT_DOUBLE_EQ(samples[0].friction_velocity, 0.4 * 8 / std::log(2e5));
  EXPECT_EQ(samples[1].direction, -0.2);
  EXPECT_EQ(samples[0].air_density, 1.225);
}

TEST(WindAhead, RefusesListsThatDoNotFitAndHeightsInTheSand) {
  aeolian_msgs::WindAhead message = wind_ahead();
  message.speed.pop_back();
  EXPECT_EQ(error_of([&] { to_wind_samples(message, 1e-5); }),
            "wind ahead: 2 lead times, 1 speeds and 2 directions, must be as many");
  message = wind_ahead();
  message.height = 0;
  EXPECT_NE(error_of([&] { to_wind_samples(message, 1e-5); }), "no error was thrown");
  message = wind_ahead();
  message.speed[0] = NAN;
  EXPECT_NE(error_of([&] { to_wind_samples(message, 1e-5); }), "no error was thrown");
}

TEST(LearnedParameters, TellMedianAndSpreadOfTheMembers) {
  LearnedState state;
  for (const double factor : {0.8, 1.25}) {
    UncertainParameters member;
    member.friction_velocity = factor;
    state.members.push_back(member);
  }
  state.updates = 3;
  ParameterLearner::Update update;
  update.learned = true;
  update.innovation = 1.5;
  const aeolian_msgs::LearnedParameters message = to_message(state, update, true, {});
  ASSERT_EQ(message.names.size(), 5U);
  EXPECT_EQ(message.names[0], "friction_velocity");
  EXPECT_EQ(message.median[0], 1);
  EXPECT_NEAR(message.sigma[0], std::log(1.25) * std::sqrt(2), 1e-12);
  EXPECT_EQ(message.sigma[1], 0);
  EXPECT_EQ(message.updates, 3U);
  EXPECT_TRUE(message.learned);
  EXPECT_TRUE(message.in_use);
  EXPECT_EQ(message.innovation, 1.5);
}

}  // namespace
}  // namespace aeolian
