#include "aeolian_core/twin/forecast_engine.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr double epoch = 1.7e9;

HeightMap flat() {
  HeightMap map(GridGeometry(0, 0, 0.005, 16, 8));
  map.add(layer::elevation, 0.01F);
  map.add(layer::variance, 1e-8F);
  map.add(layer::age, 1.0F);
  return map;
}

WindSample sample(double time) {
  WindSample s;
  s.time = epoch + time;
  s.friction_velocity = 0.4;
  return s;
}

ForecastEngine::Settings settings(bool learns = false) {
  ForecastEngine::Settings result;
  result.horizons = {10, 20};
  result.period = 10;
  result.learning_horizon = 20;
  if (learns) {
    result.learner.emplace();
    result.learner->members = 8;
  }
  return result;
}

/// An engine with wind from 0 to `until` [s].
ForecastEngine engine_with_wind(const ForecastEngine::Settings& chosen, int until) {
  ForecastEngine engine(chosen);
  for (int i = 0; i <= until; ++i) engine.take_wind(sample(i));
  return engine;
}

TEST(ForecastEngine, AForecastIsDueOnceAPeriod) {
  ForecastEngine engine = engine_with_wind(settings(), 100);
  std::vector<double> due;
  for (int i = 0; i <= 300; ++i) {
    const double time = epoch + 10 + 0.1 * i;  // a tenth of a second is no double, and rounds to either side
    if (engine.take_map(flat(), time).job) due.push_back(std::round(10 * (time - epoch)) / 10);
  }
  EXPECT_EQ(due, (std::vector<double>{10, 20, 30, 40}));
}

TEST(ForecastEngine, AJobHoldsWhatAForecastNeeds) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 100);
  ASSERT_TRUE(taken.job);
  EXPECT_EQ(taken.job->time, epoch + 100);
  EXPECT_EQ(taken.job->start.names(), (std::vector<std::string>{layer::elevation, layer::variance}));
  EXPECT_EQ(taken.job->wind.back().until, 20);
  EXPECT_EQ(taken.job->members.size(), 8U);
  EXPECT_FALSE(taken.bridged_gap);
  EXPECT_FALSE(taken.not_given_ahead);
  EXPECT_FALSE(taken.without_wind);
  EXPECT_EQ(engine.run(*taken.job).forecasts.size(), 2U);
}

TEST(ForecastEngine, WithoutALearnerThereIsOneForecast) {
  ForecastEngine engine = engine_with_wind(settings(), 10);
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 10);
  EXPECT_TRUE(taken.job->members.empty());
  EXPECT_EQ(taken.job->median.values(), UncertainParameters{}.values());
  const EnsembleForecast forecast = engine.run(*taken.job);
  EXPECT_FALSE(forecast.forecasts[0].map.has(layer::spread));
  engine.keep(*taken.job, forecast);
  EXPECT_TRUE(engine.take_map(flat(), epoch + 30).learned.empty());
}

TEST(ForecastEngine, WithoutWindItSaysSoAndTheNextMapIsDue) {
  ForecastEngine engine(settings());
  ForecastEngine::Taken taken = engine.take_map(flat(), epoch);
  EXPECT_TRUE(taken.without_wind);
  EXPECT_FALSE(taken.job);
  engine.take_wind(sample(0.5));
  taken = engine.take_map(flat(), epoch + 1);
  EXPECT_TRUE(taken.job);
  EXPECT_FALSE(taken.without_wind);
}

TEST(ForecastEngine, BridgedWindIsSaid) {
  ForecastEngine engine = engine_with_wind(settings(), 10);
  engine.take_wind(sample(40));
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 41);
  EXPECT_EQ(taken.bridged_gap, 30);
}

TEST(ForecastEngine, WindAheadIsUsedAndWhatItLacksIsSaid) {
  ForecastEngine engine = engine_with_wind(settings(), 10);
  engine.give_wind_ahead({sample(10), sample(15)});
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 10);
  ASSERT_TRUE(taken.job);
  EXPECT_EQ(taken.job->wind.size(), 2U);
  EXPECT_TRUE(taken.job->wind[0].ahead);
  EXPECT_EQ(taken.not_given_ahead, 10);
  engine.take_wind(sample(100));
  EXPECT_EQ(engine.take_map(flat(), epoch + 100).not_given_ahead, 20);  // late altogether
}

TEST(ForecastEngine, AnOlderMapBeginsAnew) {
  ForecastEngine engine = engine_with_wind(settings(), 10);
  EXPECT_TRUE(engine.take_map(flat(), epoch + 10).job);
  EXPECT_FALSE(engine.take_map(flat(), epoch + 11).job);
  engine.take_wind(sample(0));
  EXPECT_TRUE(engine.take_map(flat(), epoch).job);
  EXPECT_FALSE(engine.take_map(flat(), epoch + 1).job);
}

TEST(ForecastEngine, AJobThatWaitsGivesWayToANewerMap) {
  ForecastEngine engine = engine_with_wind(settings(), 60);
  const auto first = engine.take_map(flat(), epoch + 10);
  const auto second = engine.take_map(flat(), epoch + 20);
  ASSERT_TRUE(first.job && second.job);
  engine.defer(*second.job);
  const auto third = engine.take_map(flat(), epoch + 21);
  ASSERT_TRUE(third.job);
  engine.defer(*third.job);
  engine.begin(*third.job);
  EXPECT_FALSE(engine.take_map(flat(), epoch + 30).job);
  EXPECT_TRUE(engine.take_map(flat(), epoch + 31).job);
}

TEST(ForecastEngine, EachStretchOfTimeTeachesOnce) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  std::vector<double> lessons;
  for (int time = 10; time <= 90; ++time) {
    const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + time);
    if (!taken.learned.empty()) lessons.push_back(time);
    if (taken.job) engine.keep(*taken.job, engine.run(*taken.job));
  }
  EXPECT_EQ(lessons, (std::vector<double>{30, 50, 70, 90}));
}

TEST(ForecastEngine, NothingIsLearnedFromAMapOfAnotherTime) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 10);
  engine.keep(*taken.job, engine.run(*taken.job));
  EXPECT_TRUE(engine.take_map(flat(), epoch + 29).learned.empty());
  const ForecastEngine::Taken late = engine.take_map(flat(), epoch + 32);
  ASSERT_EQ(late.learned.size(), 1U);
  EXPECT_FALSE(late.learned[0].learned);
  EXPECT_NE(late.learned[0].why_not.find("no map came in the 1"), std::string::npos);
  EXPECT_TRUE(engine.take_map(flat(), epoch + 33).learned.empty());
}

TEST(ForecastEngine, AForecastOlderThanTheMapTeachesNothing) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 10);
  const EnsembleForecast forecast = engine.run(*taken.job);
  engine.take_map(flat(), epoch + 35);  // while it was on its way
  engine.keep(*taken.job, forecast);
  EXPECT_TRUE(engine.take_map(flat(), epoch + 36).learned.empty());

  // Nor does one of before a bag began anew.
  const ForecastEngine::Taken before = engine.take_map(flat(), epoch + 50);
  engine.take_wind(sample(0));
  engine.take_map(flat(), epoch);
  engine.keep(*before.job, engine.run(*before.job));
  EXPECT_TRUE(engine.take_map(flat(), epoch + 70).learned.empty());
}

TEST(ForecastEngine, LearningCanBeOff) {
  ForecastEngine::Settings off = settings(true);
  off.learning = false;
  ForecastEngine engine = engine_with_wind(off, 100);
  const ForecastEngine::Taken taken = engine.take_map(flat(), epoch + 10);
  EXPECT_EQ(taken.job->members.size(), 8U);
  engine.keep(*taken.job, engine.run(*taken.job));
  EXPECT_TRUE(engine.take_map(flat(), epoch + 30).learned.empty());
}

TEST(ForecastEngine, RefusesSettingsWindAndTimes) {
  const auto refusal = [](const auto& change) {
    ForecastEngine::Settings chosen = settings();
    change(chosen);
    return error_of([&] { ForecastEngine{chosen}; });
  };
  EXPECT_NE(refusal([](auto& s) { s.horizons = {20, 10}; }), "no error was thrown");
  EXPECT_NE(refusal([](auto& s) { s.horizons.clear(); }), "no error was thrown");
  EXPECT_EQ(refusal([](auto& s) { s.period = 0; }), "forecaster: period is 0, must be positive and finite");
  EXPECT_NE(refusal([](auto& s) { s.learner.emplace().members = 1; }).find("must be two or more"),
            std::string::npos);
  ForecastEngine engine(settings());
  WindSample spike = sample(1);
  spike.friction_velocity = 40;
  EXPECT_NE(error_of([&] { engine.take_wind(spike); }).find("must be 0 to 3"), std::string::npos);
  EXPECT_NE(error_of([&] { engine.take_map(flat(), NAN); }), "no error was thrown");
}

}  // namespace
}  // namespace aeolian
