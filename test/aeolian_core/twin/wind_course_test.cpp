#include "aeolian_core/twin/wind_course.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr double epoch = 1.7e9;  // where a double leaves a quarter of a microsecond

WindSample sample(double time, double friction_velocity = 0.4) {
  WindSample s;
  s.time = epoch + time;
  s.friction_velocity = friction_velocity;
  return s;
}

WindCourse steady(double until, double period = 0.1) {
  WindCourse wind({});
  for (int i = 0; i * period <= until + 1e-9; ++i) wind.add(sample(i * period));
  return wind;
}

TEST(WindCourse, TheWindSoFarGoesOn) {
  const auto spells = steady(100).spells(epoch + 100, 300);
  ASSERT_EQ(spells.size(), 1U);
  EXPECT_EQ(spells[0].until, 300);
  EXPECT_FALSE(spells[0].ahead);
  ASSERT_EQ(spells[0].samples.size(), 601U);  // both ends of the window
  EXPECT_EQ(spells[0].samples.front().time, epoch + 100);
  EXPECT_NEAR(spells[0].longest_gap, 0.1, 1e-9);
  for (std::size_t i = 1; i < spells[0].weights.size(); ++i)
    EXPECT_NEAR(spells[0].weights[i], 0.1, 1e-9) << i;
}

TEST(WindCourse, WhatCameAfterTheMapIsNotUsed) {
  const auto spells = steady(100).spells(epoch + 70, 30);
  ASSERT_EQ(spells.size(), 1U);
  EXPECT_EQ(spells[0].samples.front().time, epoch + 70);
}

TEST(WindCourse, AGapIsBridgedWithTheRest) {
  WindCourse wind({});
  wind.add(sample(0, 0.3));
  wind.add(sample(1, 0.3));
  wind.add(sample(21, 0.5));
  wind.add(sample(22, 0.5));
  const auto spells = wind.spells(epoch + 22, 60);
  ASSERT_EQ(spells.size(), 1U);
  EXPECT_EQ(spells[0].longest_gap, 20);
  // Newest first: none stands for longer than the longest gap.
  EXPECT_EQ(spells[0].weights, (std::vector<double>{1e-3, 1, 5, 1}));
}

TEST(WindCourse, WithoutWindThereIsNothing) {
  EXPECT_TRUE(WindCourse({}).spells(epoch, 60).empty());
  EXPECT_TRUE(steady(10).spells(epoch + 10 + 61, 60).empty());
  EXPECT_TRUE(steady(10).spells(epoch - 1, 60).empty());
}

TEST(WindCourse, ALoopBeginsAnew) {
  WindCourse wind = steady(100);
  wind.add(sample(0));
  EXPECT_TRUE(wind.spells(epoch + 100, 60).empty());
  EXPECT_EQ(wind.spells(epoch, 60)[0].samples.size(), 1U);
}

TEST(WindCourse, AspikeIsLeftOutInOneLine) {
  WindCourse wind = steady(10);
  const std::size_t before = wind.spells(epoch + 10, 60)[0].samples.size();
  EXPECT_EQ(
      error_of([&] { wind.add(sample(10, 12)); }),
      "wind: friction velocity at 1700000010.000000 s is 12, must be 0 to 3.000000 m/s; it is left out");
  EXPECT_NE(error_of([&] { wind.add(sample(10, NAN)); }), "no error was thrown");
  EXPECT_NE(error_of([&] { wind.add(sample(10, -0.1)); }), "no error was thrown");
  EXPECT_NE(error_of([&] { wind.add(sample(NAN)); }), "no error was thrown");
  WindSample bad = sample(10);
  bad.direction = INFINITY;
  EXPECT_NE(error_of([&] { wind.add(bad); }), "no error was thrown");
  bad = sample(10);
  bad.air_density = 0;
  EXPECT_NE(error_of([&] { wind.add(bad); }), "no error was thrown");
  EXPECT_EQ(wind.spells(epoch + 10, 60)[0].samples.size(), before);
}

TEST(WindCourse, WindGivenAheadHoldsUntilTheNext) {
  WindCourse wind = steady(10);
  wind.give_ahead({sample(0, 0.1), sample(20, 0.2), sample(50, 0.3)});
  const auto spells = wind.spells(epoch + 10, 60);
  // Means of 30 s of lead time: 10 s of the first and 20 s of the second; the rest of the second, the third.
  ASSERT_EQ(spells.size(), 2U);
  EXPECT_EQ(spells[0].until, 30);
  EXPECT_EQ(spells[0].weights, (std::vector<double>{10, 20}));
  EXPECT_EQ(spells[0].samples[0].friction_velocity, 0.1);
  EXPECT_EQ(spells[0].samples[1].friction_velocity, 0.2);
  EXPECT_EQ(spells[1].until, 60);
  EXPECT_EQ(spells[1].weights, (std::vector<double>{10, 20}));
  EXPECT_EQ(spells[1].samples[1].friction_velocity, 0.3);
  EXPECT_TRUE(spells[0].ahead && spells[1].ahead);
  EXPECT_EQ(wind.ahead_until(), epoch + 80);
}

TEST(WindCourse, WhatIsNotGivenAheadIsBridged) {
  WindCourse wind = steady(10);
  wind.give_ahead({sample(20, 0.2), sample(30, 0.3)});
  const auto spells = wind.spells(epoch + 10, 60);
  ASSERT_EQ(spells.size(), 3U);
  EXPECT_FALSE(spells[0].ahead);  // the wind so far, until what is given begins
  EXPECT_EQ(spells[0].until, 10);
  EXPECT_TRUE(spells[1].ahead);
  EXPECT_EQ(spells[1].until, 30);
  EXPECT_FALSE(spells[2].ahead);
  EXPECT_EQ(spells[2].until, 60);
  EXPECT_EQ(spells[2].samples[0].friction_velocity, 0.4);

  // What is late altogether, or beyond the forecast, changes nothing.
  for (const double time : {-100.0, 500.0}) {
    wind.give_ahead({sample(time, 0.2), sample(time + 10, 0.3)});
    const auto late = wind.spells(epoch + 10, 60);
    ASSERT_EQ(late.size(), 1U) << time;
    EXPECT_FALSE(late[0].ahead);
  }
}

TEST(WindCourse, WithoutWindSoFarWhatIsGivenAheadIsStretched) {
  WindCourse wind({});
  wind.give_ahead({sample(20, 0.2), sample(30, 0.3)});
  const auto spells = wind.spells(epoch, 60);
  ASSERT_EQ(spells.size(), 4U);
  EXPECT_EQ(spells[0].until, 20);
  EXPECT_EQ(spells[1].until, 30);
  EXPECT_EQ(spells[2].until, 40);
  EXPECT_EQ(spells[3].until, 60);
  EXPECT_EQ(spells[0].samples[0].friction_velocity, 0.2);
  EXPECT_EQ(spells[3].samples[0].friction_velocity, 0.3);
}

TEST(WindCourse, RefusesBadWindAheadAndKeepsWhatItHad) {
  WindCourse wind({});
  wind.give_ahead({sample(0, 0.2)});
  EXPECT_NE(error_of([&] {
              wind.give_ahead({sample(10), sample(10)});
            }).find("later than that of the one"),
            std::string::npos);
  EXPECT_NE(error_of([&] { wind.give_ahead({sample(10, 7)}); }).find("must be 0 to 3"), std::string::npos);
  EXPECT_EQ(wind.spells(epoch, 10)[0].samples[0].friction_velocity, 0.2);
  wind.give_ahead({});
  EXPECT_FALSE(wind.ahead_until());
}

TEST(WindCourse, RefusesSettings) {
  WindCourse::Settings settings;
  settings.window = 0;
  EXPECT_EQ(error_of([&] { WindCourse{settings}; }), "wind: window is 0, must be positive and finite");
}

}  // namespace
}  // namespace aeolian
