#include "aeolian_core/twin/forecast_scorer.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/forecast.hpp"

namespace aeolian {
namespace {

const GridGeometry geometry(0, 0, 0.005, 64, 32);

/// Ripples that have moved east, raised by some height [m].
HeightMap ripples(double moved, double raised = 0) {
  HeightMap map(geometry);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] = static_cast<float>(
        raised + 0.002 * std::sin(2 * M_PI * (geometry.x(geometry.cell_at(i).x) - moved) / 0.08));
  return map;
}

std::shared_ptr<const HeightMap> measured(double moved = 0) {
  return std::make_shared<const HeightMap>(ripples(moved));
}

/// From ripples at rest: they move by a centimetre, and the forecast is so much too high.
std::shared_ptr<const HeightMap> forecast(double lead, double raised = 0) {
  HeightMap map = ripples(0.01, raised);
  map.add(layer::initial, ripples(0).layer(layer::elevation));
  map.add(layer::lead_time, static_cast<float>(lead));
  return std::make_shared<const HeightMap>(std::move(map));
}

TEST(ForecastScorer, ScoresAgainstTheMapNearestToTheTimeOfTheForecast) {
  ForecastScorer scorer({});
  EXPECT_TRUE(scorer.take_map(measured(0), 0).scores.empty());
  EXPECT_TRUE(scorer.take_forecast(forecast(30.1, 0.001), 30.1).scores.empty());
  EXPECT_TRUE(scorer.take_map(measured(0.01), 30).scores.empty()) << "a nearer map may come";
  const auto taken = scorer.take_map(measured(0.04), 30.4);
  ASSERT_EQ(taken.scores.size(), 1U);
  const ForecastScorer::Score& score = taken.scores[0];
  EXPECT_EQ(score.refused, "");
  EXPECT_EQ(score.issued, 0);
  EXPECT_EQ(score.time, 30.1);
  EXPECT_EQ(score.measured_time, 30);
  EXPECT_NEAR(score.comparison.bias, 0.001, 1e-7);
  EXPECT_NEAR(score.comparison.rmse, 0.001, 1e-7);
  EXPECT_NEAR(score.comparison.displacement_measured, 0.01, 2e-4);
  for (const float d : score.difference.layer(layer::difference)) ASSERT_NEAR(d, 0.001, 1e-7);
  EXPECT_EQ(score.difference.layer(layer::elevation), ripples(0.01).layer(layer::elevation));
  EXPECT_TRUE(scorer.take_map(measured(), 31).scores.empty()) << "no forecast is scored twice";
}

TEST(ForecastScorer, AForecastThatComesLateIsScoredAgainstAMapThatWasKept) {
  ForecastScorer scorer({});
  for (int t = 0; t <= 15; ++t) scorer.take_map(measured(0.001 * t), t);
  const auto taken = scorer.take_forecast(forecast(10), 10);
  ASSERT_EQ(taken.scores.size(), 1U);
  EXPECT_EQ(taken.scores[0].measured_time, 10);
  EXPECT_NEAR(taken.scores[0].comparison.rmse, 0, 1e-9);
}

TEST(ForecastScorer, ThePatternIsFollowedAlongTheMeanWindOfTheForecast) {
  const auto displacement = [](const std::vector<WindSample>& wind, double direction) {
    ForecastScorer::Settings settings;
    settings.direction = direction;
    ForecastScorer scorer(settings);
    for (const WindSample& sample : wind) scorer.take_wind(sample);
    scorer.take_map(measured(0), 0);
    scorer.take_forecast(forecast(30), 30);
    return scorer.take_map(measured(0.01), 30).scores.at(0).comparison.displacement_measured;
  };
  const WindSample westwards{15, 0.4, M_PI};
  EXPECT_NEAR(displacement({}, 0), 0.01, 2e-4);
  EXPECT_NEAR(displacement({westwards}, 0), -0.01, 2e-4);
  EXPECT_NEAR(displacement({{31, 0.4, M_PI}, {-1, 0.4, M_PI}}, 0), 0.01, 2e-4) << "not during the forecast";
  EXPECT_NEAR(displacement({westwards, {0, 0.5, 0}}, M_PI), 0.01, 2e-4) << "the stronger wind counts more";
}

TEST(ForecastScorer, ToleranceHoldsToTheNanosecond) {
  ForecastScorer::Settings settings;
  settings.tolerance = 0.3;
  for (const double late : {0.3, 0.300000001}) {
    ForecastScorer scorer(settings);
    scorer.take_forecast(forecast(30), 86400.1);
    const auto taken = scorer.take_map(measured(0.01), 86400.1 + late);
    ASSERT_EQ(taken.scores.size(), 1U);
    EXPECT_EQ(taken.scores[0].refused,
              late > 0.3 ? "the nearest map is 0.30 s away, must be within 0.3 s (~tolerance)" : "");
  }
}

TEST(ForecastScorer, SaysWhatItDrops) {
  ForecastScorer::Settings settings;
  settings.max_pending = 2;
  ForecastScorer scorer(settings);
  EXPECT_EQ(scorer.newest_map(), nullptr);
  EXPECT_FALSE(scorer.take_forecast(forecast(10), 10).oldest_dropped);
  EXPECT_FALSE(scorer.take_forecast(forecast(20), 20).oldest_dropped);
  EXPECT_TRUE(scorer.take_forecast(forecast(30), 30).oldest_dropped);
  EXPECT_FALSE(scorer.take_map(measured(), 11).begun_anew);
  const auto back = scorer.take_map(measured(), 3);
  ASSERT_TRUE(back.begun_anew);
  EXPECT_EQ(*back.begun_anew, 2U);
  EXPECT_TRUE(scorer.take_map(measured(), 40).scores.empty());
}

TEST(ForecastScorer, AForecastWithoutAKnownCellIsRefused) {
  ForecastScorer scorer({});
  HeightMap empty = *forecast(10);
  empty.add(layer::lead_time);
  scorer.take_forecast(std::make_shared<const HeightMap>(empty), 10);
  const auto taken = scorer.take_map(measured(), 10);
  ASSERT_EQ(taken.scores.size(), 1U);
  EXPECT_EQ(taken.scores[0].refused, "forecast: layer 'lead_time' has no known cell");
}

}  // namespace
}  // namespace aeolian
