#include "aeolian_core/twin/parameter_learner.hpp"

#include <cmath>

#include "error_of.hpp"
#include "temporary_folder.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double lead = 60;

TwinPhysics physics() {
  TwinPhysics result;
  result.grain.diameter = 0.0004;
  return result;
}

/// Ripples of 5 mm and 6 cm across a plot of 30 cm, not quite straight.
HeightMap ripples(double height = 0.005) {
  HeightMap map(GridGeometry(0, 0, 0.004, 76, 40));
  HeightMap::Layer& elevation = map.add(layer::elevation, 0);
  const GridGeometry& g = map.geometry();
  for (std::size_t i = 0; i < g.size(); ++i) {
    const CellIndex c = g.cell_at(i);
    const double phase = 2 * M_PI * (g.x(c.x) + 0.01 * std::sin(40 * g.y(c.y))) / 0.06;
    elevation[i] = static_cast<float>(height / 2 * (std::sin(phase) + 0.2 * std::sin(2 * phase)));
  }
  return map;
}

std::vector<WindSpell> wind(double friction_velocity) {
  return {{lead, {{0, friction_velocity, 0.1}}, {1.0}, 0, false}};
}

ForecastEnsemble ensemble(double wind_error = 0) {
  ForecastEnsemble::Settings settings;
  settings.wind_error = settings.direction_error = wind_error;
  return {physics(), settings};
}

EnsembleForecast predict(const ParameterLearner& learner, const HeightMap& start,
                         double friction_velocity = 0.45, double wind_error = 0) {
  return ensemble(wind_error)
      .run(start, wind(friction_velocity), {lead}, learner.members(), learner.median());
}

/// What a bed of the same physics but these parameters becomes, with noise of 0.1 mm.
HeightMap truth(const HeightMap& start, const UncertainParameters& parameters,
                double friction_velocity = 0.45) {
  HeightMap map =
      ensemble().run(start, wind(friction_velocity), {lead}, {}, parameters).forecasts.front().map;
  RandomStream random(3, 3);
  for (float& z : map.layer(layer::elevation)) z += 1e-4F * static_cast<float>(random.normal());
  map.add(layer::variance, 1e-8F);
  return map;
}

double spread(const ParameterLearner& learner, std::size_t parameter) {
  const double middle = std::log(learner.median().values()[parameter]);
  double sum = 0;
  for (const UncertainParameters& member : learner.members())
    sum += std::pow(std::log(member.values()[parameter]) - middle, 2);
  return std::sqrt(sum / static_cast<double>(learner.members().size() - 1));
}

bool same(const std::vector<UncertainParameters>& a, const std::vector<UncertainParameters>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& left, const auto& right) { return left.values() == right.values(); });
}

TEST(ParameterLearner, BeginsWithThePriorsToTheDigit) {
  const ParameterLearner learner({});
  const ParameterPriors priors = default_priors();
  for (std::size_t j = 0; j < priors.size(); ++j) {
    EXPECT_NEAR(learner.median().values()[j], priors[j].median, 1e-9);
    EXPECT_NEAR(spread(learner, j), priors[j].sigma, 1e-9);
  }
}

TEST(ParameterLearner, FindsTheWindThatMovedTheBed) {
  ParameterLearner learner({});
  UncertainParameters parameters;
  parameters.friction_velocity = 1.13;
  HeightMap bed = ripples();
  for (int round = 0; round < 3; ++round) {
    const HeightMap later = truth(bed, parameters);
    const auto update = learner.learn(predict(learner, bed), 0, later);
    EXPECT_TRUE(update.learned) << update.why_not;
    bed = later;
  }
  EXPECT_NEAR(learner.median().friction_velocity, 1.13, 0.05 * 1.13);
  EXPECT_EQ(learner.state().updates, 3U);
}

TEST(ParameterLearner, WhatItLearnedForecastsBetter) {
  ParameterLearner learner({});
  const UncertainParameters parameters{1.12, 1.1, 0.95, 1, 1};
  const HeightMap bed = ripples();
  const HeightMap later = truth(bed, parameters);
  const auto miss = [&](const UncertainParameters& guess) {
    const auto forecast = ensemble().run(bed, wind(0.45), {lead}, {}, guess);
    const HeightMap::Layer& predicted = forecast.forecasts.front().map.layer(layer::elevation);
    const HeightMap::Layer& found = later.layer(layer::elevation);
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      sum += std::pow(static_cast<double>(predicted[i]) - static_cast<double>(found[i]), 2);
    return std::sqrt(sum / static_cast<double>(found.size()));
  };
  learner.learn(predict(learner, bed), 0, later);
  EXPECT_LT(miss(learner.median()), 0.6 * miss({}));
}

/// The members' mean is not the forecast of the mean parameters; the difference must teach nothing.
TEST(ParameterLearner, AGoodForecastIsNotSpoilt) {
  ParameterLearner learner({});
  const HeightMap bed = ripples();
  const HeightMap later = truth(bed, {});
  for (int round = 0; round < 3; ++round) learner.learn(predict(learner, bed), 0, later);
  EXPECT_NEAR(learner.median().friction_velocity, 1, 0.02);
  EXPECT_NEAR(learner.median().reptation_length, 1, 0.05);
  EXPECT_NEAR(learner.median().impact_angle, 1, 0.04);
}

TEST(ParameterLearner, InACalmNothingIsLearned) {
  ParameterLearner learner({});
  const auto before = learner.members();
  const HeightMap bed = ripples();
  const auto update = learner.learn(predict(learner, bed, 0.1), 0, truth(bed, {}, 0.1));
  EXPECT_FALSE(update.learned);
  EXPECT_EQ(update.why_not, "the surface does not tell of the parameters");
  EXPECT_TRUE(same(learner.members(), before));
}

TEST(ParameterLearner, AFlatBedTellsNothingOfPeriodicSand) {
  ParameterLearner learner({});
  TwinPhysics periodic = physics();
  periodic.ripple.border = Border::periodic;
  const HeightMap bed = ripples(0);
  const auto before = learner.members();
  const EnsembleForecast forecast =
      ForecastEnsemble(periodic, {}).run(bed, wind(0.45), {lead}, learner.members(), learner.median());
  HeightMap later = bed;
  RandomStream random(3, 3);
  for (float& z : later.layer(layer::elevation)) z += 1e-4F * static_cast<float>(random.normal());
  EXPECT_FALSE(learner.learn(forecast, 0, later).learned);
  EXPECT_TRUE(same(learner.members(), before));
}

/// Nothing comes over the border of a periodic bed, however much of it there might be.
TEST(ParameterLearner, AParameterWithoutEffectKeepsItsPrior) {
  ParameterLearner learner({});
  TwinPhysics periodic = physics();
  periodic.ripple.border = Border::periodic;
  HeightMap bed(GridGeometry(0, 0, 0.004, 75, 40));
  bed.add(layer::elevation, 0);
  const GridGeometry& g = bed.geometry();
  for (std::size_t i = 0; i < g.size(); ++i)
    bed.layer(layer::elevation)[i] =
        static_cast<float>(0.0025 * std::sin(2 * M_PI * g.x(g.cell_at(i).x) / 0.06));
  const ForecastEnsemble members(periodic, {});
  const UncertainParameters parameters{1.1, 1, 1, 1, 1};
  const HeightMap later = members.run(bed, wind(0.45), {lead}, {}, parameters).forecasts.front().map;
  for (int round = 0; round < 5; ++round)
    learner.learn(members.run(bed, wind(0.45), {lead}, learner.members(), learner.median()), 0, later);
  EXPECT_GT(spread(learner, 4), 0.9 * default_priors()[4].sigma);
  EXPECT_LT(spread(learner, 0), 0.6 * default_priors()[0].sigma);
}

TEST(ParameterLearner, StaysWithinBoundsWhateverIsMeasured) {
  ParameterLearner::Settings settings;
  settings.priors[0].low = 0.9;
  settings.priors[0].high = 1.05;
  ParameterLearner learner(settings);
  const HeightMap bed = ripples();
  UncertainParameters parameters;
  parameters.friction_velocity = 1.4;
  const HeightMap later = truth(bed, parameters);
  for (int round = 0; round < 3; ++round) learner.learn(predict(learner, bed), 0, later);
  for (const UncertainParameters& member : learner.members()) {
    EXPECT_GE(member.friction_velocity, 0.9);
    EXPECT_LE(member.friction_velocity, 1.05);
  }
}

TEST(ParameterLearner, DoesNotCollapse) {
  ParameterLearner learner({});
  const HeightMap bed = ripples();
  const HeightMap later = truth(bed, {});
  for (int round = 0; round < 20; ++round) learner.learn(predict(learner, bed), 0, later);
  for (std::size_t j = 0; j < UncertainParameters::count; ++j)
    EXPECT_GT(spread(learner, j), 0.39 * default_priors()[j].sigma);
}

TEST(ParameterLearner, AFootprintDoesNotMisleadIt) {
  const HeightMap bed = ripples();
  HeightMap later = truth(bed, {});
  const GridGeometry& g = later.geometry();
  for (int y = 10; y < 20; ++y)
    for (int x = 30; x < 55; ++x) later.layer(layer::elevation)[g.index(x, y)] -= 0.02F;
  ParameterLearner learner({});
  for (int round = 0; round < 3; ++round) learner.learn(predict(learner, bed), 0, later);
  EXPECT_NEAR(learner.median().friction_velocity, 1, 0.05);
}

TEST(ParameterLearner, UnknownCellsAndOtherGridsAreNoMatter) {
  ParameterLearner learner({});
  UncertainParameters parameters;
  parameters.friction_velocity = 1.13;
  const HeightMap bed = ripples();
  HeightMap later = truth(bed, parameters);
  for (int x = 20; x < 30; ++x)
    later.layer(layer::elevation)[later.geometry().index(x, 7)] = HeightMap::unknown;
  HeightMap moved(GridGeometry(-0.05, -0.05, 0.002, 200, 130));
  HeightMap::Layer& elevation = moved.add(layer::elevation);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 152; ++x)
      elevation[moved.geometry().index(x + 25, y + 25)] =
          later.layer(layer::elevation)[later.geometry().index(x / 2, y / 2)];
  EXPECT_TRUE(learner.learn(predict(learner, bed), 0, moved).learned);
  EXPECT_GT(learner.median().friction_velocity, 1.05);
}

TEST(ParameterLearner, SaysWhyItDidNotLearn) {
  ParameterLearner learner({});
  const HeightMap bed = ripples();
  const EnsembleForecast forecast = predict(learner, bed);
  HeightMap unknown(bed.geometry());
  unknown.add(layer::elevation);
  EXPECT_EQ(learner.learn(forecast, 0, unknown).why_not,
            "too few cells are known in forecast and measurement");
  HeightMap elsewhere(GridGeometry(50, 50, 0.004, 76, 40));
  elsewhere.add(layer::elevation, 0);
  EXPECT_FALSE(learner.learn(forecast, 0, elsewhere).learned);
  EXPECT_TRUE(learner.learn(forecast, 0, truth(bed, {})).learned);
  EXPECT_EQ(learner.learn(forecast, 0, truth(bed, {})).why_not,
            "the forecast was made with other parameters");
  EXPECT_EQ(error_of([&] { learner.learn(forecast, 1, bed); }),
            "learning: there is no horizon 1, the forecast has 1");
}

TEST(ParameterLearner, FrozenItWatches) {
  ParameterLearner learner({});
  learner.freeze(true);
  const auto before = learner.members();
  const HeightMap bed = ripples();
  UncertainParameters parameters;
  parameters.friction_velocity = 1.3;
  const auto update = learner.learn(predict(learner, bed), 0, truth(bed, parameters));
  EXPECT_EQ(update.why_not, "frozen");
  EXPECT_GT(update.innovation, 1);
  EXPECT_TRUE(same(learner.members(), before));
  learner.freeze(false);
  EXPECT_TRUE(learner.learn(predict(learner, bed), 0, truth(bed, parameters)).learned);
}

TEST(ParameterLearner, ComesBackFromItsFileBitForBit) {
  const TemporaryFolder folder;
  ParameterLearner learner({});
  const HeightMap bed = ripples();
  learner.learn(predict(learner, bed), 0, truth(bed, {1.1, 1, 1, 1, 1}));
  learner.save(folder.file("learned.yaml"));
  ParameterLearner other({});
  other.load(folder.file("learned.yaml"));
  EXPECT_TRUE(same(other.members(), learner.members()));
  EXPECT_EQ(other.state().updates, 1U);
}

TEST(ParameterLearner, RefusesBadFilesInOneLineAndKeepsWhatItKnows) {
  const TemporaryFolder folder;
  ParameterLearner learner({});
  const auto before = learner.members();
  std::string rows;
  for (int i = 0; i < 20; ++i) rows += "  - [1, 1, 1, 1, 1]\n";
  const std::string row = "  - [1, 1, 1, 1, 1]\n";
  const auto refusal = [&](const std::string& text) {
    const std::string path = folder.write("bad.yaml", text);
    const std::string message = error_of([&] { learner.load(path); });
    EXPECT_EQ(message.rfind(path, 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(path.size());
  };
  const std::string head = "version: 1\nupdates: 3\nmembers:\n";
  EXPECT_EQ(refusal("version: 2\nupdates: 3\nmembers:\n" + rows), ":1: version is '2', must be 1");
  EXPECT_EQ(refusal(head + row), ": 1 members, must be 20 as set");
  EXPECT_EQ(refusal(head + rows.substr(row.size()) + "  - [1, 1, 9, 1, 1]\n"),
            ":23: members[19] is [1, 1, 9, 1, 1], impact_angle is 9, must be from 0.5 to 2");
  EXPECT_NE(refusal(head + rows.substr(row.size()) + "  - [1, 1, .nan, 1, 1]\n").find("members[19]"),
            std::string::npos);
  EXPECT_NE(refusal(head + "  - [1, 1]\n").find("must be a list of 5 numbers"), std::string::npos);
  EXPECT_NE(refusal(head + rows + "more: 1\n").find("unknown key 'more'"), std::string::npos);
  EXPECT_NE(refusal("updates: 3\n").find("there is no key 'version'"), std::string::npos);
  EXPECT_NE(refusal("version: [").find(":"), std::string::npos);
  EXPECT_NE(error_of([&] { learner.load(folder.file("none.yaml")); }).find("cannot be read"),
            std::string::npos);
  EXPECT_TRUE(same(learner.members(), before));
}

TEST(ParameterLearner, RefusesSettings) {
  const auto refusal = [](const auto& change) {
    ParameterLearner::Settings settings;
    change(settings);
    return error_of([&] { ParameterLearner learner(settings); });
  };
  EXPECT_EQ(refusal([](auto& s) { s.members = 7; }).substr(0, 40),
            "learning: members is 7, must be 8 to 100");
  EXPECT_NE(refusal([](auto& s) { s.cell = -1; }).find("cell is -1"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.block = 0; }).find("block is 0, must be positive"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.least_spread = 2; }).find("least_spread is 2"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.priors[2].median = 9; }).find("impact_angle"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
