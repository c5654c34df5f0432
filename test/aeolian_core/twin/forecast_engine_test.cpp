#include "aeolian_core/twin/forecast_engine.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/bed_movement.hpp"
#include "aeolian_core/twin/map_error.hpp"

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

HeightMap rippled() {
  const GridGeometry plot(0, 0, 0.004, 100, 24);
  HeightMap map(plot);
  HeightMap::Layer& z = map.add(layer::elevation, 0.0F);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(0.002 * std::sin(2 * M_PI * plot.x(plot.cell_at(i).x) / 0.08));
  return map;
}

WindSample sample(double time, double friction_velocity = 0.4) {
  WindSample s;
  s.time = epoch + time;
  s.friction_velocity = friction_velocity;
  return s;
}

ForecastEngine::Settings settings(bool learns = false) {
  ForecastEngine::Settings result;
  result.horizons = {10, 20};
  result.period = 10;
  result.learning_period = 20;
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
  EXPECT_FALSE(engine.take_map(flat(), epoch + 40).learned);
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
  engine.defer(second.job->time);
  const auto third = engine.take_map(flat(), epoch + 21);
  ASSERT_TRUE(third.job);
  engine.defer(third.job->time);
  engine.begin(third.job->time);
  EXPECT_FALSE(engine.take_map(flat(), epoch + 30).job);
  EXPECT_TRUE(engine.take_map(flat(), epoch + 31).job);
}

TEST(ForecastEngine, EachStretchOfTimeTeachesOnce) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  std::vector<double> lessons;
  for (int time = 10; time <= 90; ++time)
    if (engine.take_map(rippled(), epoch + time).learned) lessons.push_back(time);
  EXPECT_EQ(lessons, (std::vector<double>{30, 50, 70, 90}));
}

TEST(ForecastEngine, AMapIsLearnedFromInTheWindThatBlewAndNotInThatWhichWasForeseen) {
  ForecastEngine::Settings chosen = settings(true);
  chosen.learning_period = 30;
  const HeightMap start = rippled();
  RippleModel model(chosen.physics.ripple);
  WindSpell gale;
  gale.samples = {sample(0, 0.5)};
  gale.weights = {1};
  HeightMap later = start;
  model.advance(later, forcing_of(chosen.physics, gale, {}), 30);

  const auto learned_in = [&](double friction_velocity) {
    ForecastEngine engine(chosen);
    for (int i = 0; i <= 10; ++i) engine.take_wind(sample(i, 0.3));
    engine.take_map(start, epoch + 10);  // as foreseen, a light wind goes on
    for (int i = 10; i <= 40; ++i) engine.take_wind(sample(i, friction_velocity));
    const auto update = engine.take_map(later, epoch + 40).learned;
    EXPECT_TRUE(update && update->learned) << (update ? update->why_not : "nothing");
    return update ? update->after.friction_velocity : 0;
  };
  EXPECT_NEAR(learned_in(0.5), 1, 0.02);
  EXPECT_GT(learned_in(0.42), 1.08);  // an anemometer that reads too little
}

/// The twin's own model moves ripples for half a minute and another.
std::vector<HeightMap> moved_ripples() {
  std::vector<HeightMap> beds{rippled()};
  WindSpell breeze;
  breeze.samples = {sample(0)};
  breeze.weights = {1};
  const TwinPhysics physics;
  RippleModel model(physics.ripple);
  for (int i = 0; i < 2; ++i) {
    beds.push_back(beds.back());
    model.advance(beds.back(), forcing_of(physics, breeze, {}), 30);
  }
  return beds;
}

/// What comes of maps of these beds each half minute, with a standard deviation of each cell [m].
std::vector<std::optional<ParameterLearner::Update>> lessons_of(const std::vector<HeightMap>& beds,
                                                                double standard_deviation) {
  ForecastEngine::Settings chosen = settings(true);
  chosen.learning_period = 30;
  ForecastEngine engine = engine_with_wind(chosen, 100);
  std::vector<std::optional<ParameterLearner::Update>> lessons;
  double time = epoch + 10;
  for (HeightMap map : beds) {
    map.add(layer::variance, static_cast<float>(standard_deviation * standard_deviation));
    lessons.push_back(engine.take_map(map, time).learned);
    time += 30;
  }
  return lessons;
}

TEST(ForecastEngine, ALessonWaitsUntilTheBedHasMovedBeyondTheNoise) {
  const std::vector<HeightMap> beds = moved_ripples();
  // A live map takes the bed to be at rest until it is seen to move.
  const std::vector<HeightMap> seen{beds[0], beds[0], beds[2]};
  const auto hasty = lessons_of(seen, 1e-6);
  ASSERT_TRUE(hasty[1] && hasty[1]->learned);
  EXPECT_LT(hasty[1]->after.friction_velocity, 0.95);

  const double noise = 0.6 * rms_movement(beds[0], beds[1]);  // two of which it has not moved
  const auto patient = lessons_of(seen, noise);
  EXPECT_FALSE(patient[1]);
  ASSERT_TRUE(patient[2] && patient[2]->learned);
  EXPECT_NEAR(patient[2]->after.friction_velocity, 1, 0.02);
}

/// Independent from cell to cell.
HeightMap with_noise(HeightMap map, double standard_deviation, std::uint64_t seed) {
  RandomStream random(seed, 1);
  for (float& z : map.layer(layer::elevation)) z += static_cast<float>(standard_deviation * random.normal());
  map.add(layer::variance, static_cast<float>(standard_deviation * standard_deviation));
  return map;
}

/// How many lessons are taken from nine maps that `later(seed)` makes of a bed at rest, in a weak wind.
template <class Later>
int lessons_at_rest(const Later& later) {
  ForecastEngine engine(settings(true));
  int lessons = 0;
  for (int time = 0; time <= 180; ++time) {
    engine.take_wind(sample(time, 0.23));
    if (time % 20 != 0) continue;
    const auto update = engine.take_map(later(time / 20), epoch + time).learned;
    if (update && update->learned) ++lessons;
  }
  return lessons;
}

TEST(ForecastEngine, ABedAtRestTeachesNothingWhateverTheNoise) {
  constexpr double noise = 0.0004;
  const auto seen = [](std::uint64_t seed) { return with_noise(rippled(), noise, seed); };
  EXPECT_EQ(lessons_at_rest(seen), 0);
  EXPECT_EQ(lessons_at_rest([&](std::uint64_t seed) {
              HeightMap lifted = seen(seed);
              for (float& z : lifted.layer(layer::elevation)) z += 0.002F * static_cast<float>(seed);
              return lifted;
            }),
            0);
  EXPECT_EQ(lessons_at_rest([&](std::uint64_t seed) {
              HeightMap trodden = seen(seed);
              HeightMap::Layer& z = trodden.layer(layer::elevation);
              const std::size_t part = z.size() / 6;
              for (std::size_t i = 0; i < part; ++i) z[i + part * (seed % 6)] -= 0.002F;
              return trodden;
            }),
            0);
}

TEST(ForecastEngine, ABedThatHardlyMovesTeachesNothing) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  HeightMap map = rippled();
  map.add(layer::variance, 1e-4F);
  std::vector<double> told;
  for (int time = 10; time <= 90; ++time) {
    const auto update = engine.take_map(map, epoch + time).learned;
    if (!update) continue;
    told.push_back(time);
    EXPECT_FALSE(update->learned);
    EXPECT_NE(update->why_not.find("hardly moved"), std::string::npos);
  }
  EXPECT_EQ(told, (std::vector<double>{70}));
}

/// The twin's own model moves a bed by the minute in a wind, which the engine is told wrong by a factor.
class ToldDay {
 public:
  explicit ToldDay(double factor) : factor_(factor) {
    chosen_.horizons = {180};
    chosen_.period = chosen_.learning_period = 60;
    chosen_.learner.emplace();
  }

  ForecastEngine::Settings chosen_;
  double standard_deviation_ = 0;  ///< which maps tell of their cells [m]

  /// A map comes, and a minute goes by; so often. The last job.
  ForecastJob after(ForecastEngine& engine, int maps) {
    ForecastJob job;
    for (int i = 0; i < maps; ++i, ++minute_) {
      for (int second = minute_ == 0 ? 0 : -59; second <= 0; ++second)
        engine.take_wind(sample(60 * minute_ + second, 0.45 * factor_));
      HeightMap map = bed_;
      map.add(layer::variance, static_cast<float>(standard_deviation_ * standard_deviation_));
      auto taken = engine.take_map(map, epoch + 60 * minute_);
      if (taken.job) job = std::move(*taken.job);
      WindSpell breeze;
      breeze.samples = {sample(0, 0.45)};
      breeze.weights = {1};
      RippleModel(chosen_.physics.ripple).advance(bed_, forcing_of(chosen_.physics, breeze, {}), 60);
    }
    return job;
  }

 private:
  double factor_;
  int minute_ = 0;
  HeightMap bed_ = [] {
    const GridGeometry plot(0, 0, 0.005, 80, 40);
    HeightMap map(plot);
    map.add(layer::elevation, smooth_noise(plot, 0.03, 1, 1));
    for (float& z : map.layer(layer::elevation)) z *= 0.001F;
    return map;
  }();
};

TEST(ForecastEngine, WhatWasLearnedIsUsedOnceItHasForecastBetter) {
  ToldDay day(0.87);
  ForecastEngine engine(day.chosen_);
  EXPECT_EQ(day.after(engine, 1).median.values(), UncertainParameters{}.values());
  EXPECT_FALSE(engine.believes());
  const ForecastJob job = day.after(engine, 6);
  EXPECT_TRUE(engine.believes());
  EXPECT_EQ(job.median.values(), engine.learner()->median().values());
  EXPECT_NEAR(job.median.friction_velocity, 1 / 0.87, 0.03);
}

/// What three lessons have told with great certainty.
void load_friction_velocity(ForecastEngine& engine, double factor, ParameterLearner::Settings settings) {
  settings.priors[0] = {factor, 0.005, 0.5, 2};
  const std::string path = testing::TempDir() + "sure.yaml";
  ParameterLearner(settings).save(path);
  std::string text = [&] {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  text.replace(text.find("updates: 0"), 10, "updates: 3");
  std::ofstream(path) << text;
  engine.learner()->load(path);
}

TEST(ForecastEngine, WhatWasLoadedIsUsedUntilItIsRefuted) {
  ToldDay day(1);
  day.chosen_.learner->least_spread = 0;
  ForecastEngine engine(day.chosen_);
  load_friction_velocity(engine, 1.3, *day.chosen_.learner);
  const ForecastJob first = day.after(engine, 1);
  EXPECT_NEAR(first.median.friction_velocity, 1.3, 1e-3);
  const ForecastJob job = day.after(engine, 6);
  EXPECT_FALSE(engine.believes());
  EXPECT_EQ(job.median.values(), UncertainParameters{}.values());
  EXPECT_EQ(job.members.front().values(), ParameterLearner(*day.chosen_.learner).members().front().values());
}

/// What an engine that is sure of a factor finds when a bed surely moves.
double recovered_from(double factor) {
  ToldDay day(1);
  day.standard_deviation_ = 1e-4;
  ForecastEngine engine(day.chosen_);
  load_friction_velocity(engine, factor, *day.chosen_.learner);
  day.after(engine, 14);
  return engine.learner()->median().friction_velocity;
}

TEST(ForecastEngine, ABedThatIsSeenToMoveTeachesThoughWhatWasLearnedMovesNoSand) {
  EXPECT_NEAR(recovered_from(0.7), 1, 0.03);
  EXPECT_NEAR(recovered_from(0.51), 1, 0.03);  // 0.23 m/s, near the threshold
}

TEST(ForecastEngine, NothingIsLearnedFromAMapThatComesTooLate) {
  ForecastEngine engine = engine_with_wind(settings(true), 100);
  engine.take_map(rippled(), epoch + 10);
  const auto late = engine.take_map(rippled(), epoch + 71).learned;
  ASSERT_TRUE(late);
  EXPECT_FALSE(late->learned);
  EXPECT_NE(late->why_not.find("no map came within 60"), std::string::npos);
  EXPECT_TRUE(engine.take_map(rippled(), epoch + 91).learned);  // it was the start of the next lesson
}

TEST(ForecastEngine, NothingIsLearnedWithoutTheWindThatBlew) {
  ForecastEngine engine = engine_with_wind(settings(true), 15);
  engine.take_map(flat(), epoch + 10);
  const auto unknown = engine.take_map(flat(), epoch + 30).learned;
  ASSERT_TRUE(unknown);
  EXPECT_NE(unknown->why_not.find("the wind that blew is not known"), std::string::npos);
  engine.take_wind(sample(30));
  engine.take_wind(sample(50));
  const auto gap = engine.take_map(flat(), epoch + 50).learned;
  ASSERT_TRUE(gap);
  EXPECT_NE(gap->why_not.find("the wind has a gap of 20"), std::string::npos);
}

TEST(ForecastEngine, LearningCanBeOff) {
  ForecastEngine::Settings off = settings(true);
  off.learning = false;
  ForecastEngine engine = engine_with_wind(off, 100);
  EXPECT_EQ(engine.take_map(flat(), epoch + 10).job->members.size(), 8U);
  EXPECT_FALSE(engine.take_map(flat(), epoch + 30).learned);
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
  EXPECT_NE(refusal([](auto& s) { s.learner.emplace().members = 1; }).find("members is 1, must be"),
            std::string::npos);
  ForecastEngine engine(settings());
  WindSample spike = sample(1);
  spike.friction_velocity = 40;
  EXPECT_NE(error_of([&] { engine.take_wind(spike); }).find("must be 0 to 3"), std::string::npos);
  EXPECT_NE(error_of([&] { engine.take_map(flat(), NAN); }), "no error was thrown");
}

}  // namespace
}  // namespace aeolian
