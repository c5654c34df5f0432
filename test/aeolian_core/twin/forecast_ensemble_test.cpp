#include "aeolian_core/twin/forecast_ensemble.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/twin/forecast_spread.hpp"

namespace aeolian {
namespace {

const std::vector<double> horizons{20, 60};

HeightMap ripples(const GridGeometry& geometry = GridGeometry(0, 0, 0.004, 80, 40)) {
  HeightMap map(geometry);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] =
        static_cast<float>(0.01 + 0.002 * std::sin(2 * M_PI * geometry.x(geometry.cell_at(i).x) / 0.08));
  return map;
}

std::vector<WindSpell> wind(double friction_velocity, double time = 1000) {
  WindSample sample;
  sample.time = time;
  sample.friction_velocity = friction_velocity;
  sample.direction = 0.1;
  return {{horizons.back(), {sample}, {1}, 0, false}};
}

/// The forecast of the given parameters alone.
std::vector<Forecast> plain(const HeightMap& start, const UncertainParameters& parameters = {}) {
  const TwinPhysics physics;
  RippleModel model(ripple_parameters(physics, parameters));
  return make_forecasts(start, forcing_of(physics, wind(0.45)[0], parameters), horizons, model);
}

ForecastEnsemble::Settings exact() {
  ForecastEnsemble::Settings settings;
  settings.wind_error = 0;
  settings.model_error_speed = 0;
  settings.direction_error = 0;
  return settings;
}

EnsembleForecast run(const ForecastEnsemble::Settings& settings, const HeightMap& start,
                     std::size_t members = 5, double friction_velocity = 0.45, double time = 1000) {
  return ForecastEnsemble({}, settings)
      .run(start, wind(friction_velocity, time), horizons, draw_parameters(default_priors(), members, 1), {});
}

double mean_of(const HeightMap::Layer& values) {
  double sum = 0;
  for (const float z : values) sum += z;
  return sum / static_cast<double>(values.size());
}

TEST(ForecastEnsemble, WithoutMembersItIsThePlainForecast) {
  const HeightMap start = ripples();
  const EnsembleForecast result = ForecastEnsemble({}, {}).run(start, wind(0.45), horizons, {}, {});
  const std::vector<Forecast> expected = plain(start);
  ASSERT_EQ(result.forecasts.size(), 2U);
  for (std::size_t h = 0; h < 2; ++h) {
    EXPECT_EQ(result.forecasts[h].map.names(), expected[h].map.names());
    EXPECT_EQ(result.forecasts[h].map.layer(layer::elevation), expected[h].map.layer(layer::elevation));
  }
  EXPECT_TRUE(result.members.empty());
}

TEST(ForecastEnsemble, MembersLeaveTheElevationAsItIs) {
  const HeightMap start = ripples();
  const EnsembleForecast result = run({}, start);
  for (std::size_t h = 0; h < 2; ++h)
    EXPECT_EQ(result.forecasts[h].map.layer(layer::elevation), plain(start)[h].map.layer(layer::elevation));
}

TEST(ForecastEnsemble, OfABedThatRepeatsMembersRunOnCellsThatDivideIt) {
  TwinPhysics physics;
  physics.ripple.border = Border::periodic;
  ForecastEnsemble::Settings settings;
  settings.member_cell = 0.012;  // three cells, which do not divide 80
  const EnsembleForecast result =
      ForecastEnsemble(physics, settings)
          .run(ripples(), wind(0.45), horizons, draw_parameters(default_priors(), 5, 1), {});
  EXPECT_DOUBLE_EQ(result.member_geometry.cell(), 0.008);
  EXPECT_DOUBLE_EQ(result.member_geometry.length_x(), 0.32);
}

TEST(ForecastEnsemble, AMemberIsTheForecastOfItsParameters) {
  const HeightMap start = ripples();
  const EnsembleForecast result = run(exact(), start);
  ASSERT_EQ(result.members.size(), 5U);
  EXPECT_EQ(result.member_geometry, start.geometry());
  for (const MemberForecast& member : result.members) {
    const std::vector<Forecast> expected = plain(start, member.parameters);
    for (std::size_t h = 0; h < 2; ++h)
      EXPECT_EQ(member.elevation[h], expected[h].map.layer(layer::elevation));
  }
}

TEST(ForecastEnsemble, SpreadIsTheScatterOfTheMembersAndWhatComesOverTheBorder) {
  const HeightMap start = ripples();
  const EnsembleForecast result = run(exact(), start);
  const Forecast& forecast = result.forecasts[1];
  const HeightMap::Layer& spread = forecast.map.layer(layer::spread);
  const BorderError border = border_error(forecast, forcing_of({}, wind(0.45)[0], {}),
                                          RippleParameters{}.hop_shortening, RippleParameters{}.slope_effect);
  const GridGeometry& g = start.geometry();
  for (std::size_t i = 0; i < spread.size(); i += 37) {
    double mean = 0;
    for (const auto& member : result.members) mean += member.elevation[1][i] / 5.0;
    double square = 0;
    for (const auto& member : result.members) square += std::pow(member.elevation[1][i] - mean, 2) / 4;
    const double at_border = border.at(g, g.x(g.cell_at(i).x), g.y(g.cell_at(i).y));
    EXPECT_NEAR(spread[i], std::sqrt(square + at_border * at_border), 1e-7);
  }
  EXPECT_GT(mean_of(spread), 1.5 * mean_of(result.forecasts[0].map.layer(layer::spread)));
}

TEST(ForecastEnsemble, OnABedWithoutEndNothingComesOverABorder) {
  TwinPhysics physics;
  physics.ripple.border = Border::periodic;
  const EnsembleForecast result =
      ForecastEnsemble(physics, exact())
          .run(ripples(), wind(0.45), horizons, std::vector<UncertainParameters>(3), {});
  for (const float s : result.forecasts[1].map.layer(layer::spread)) EXPECT_EQ(s, 0);
}

TEST(BorderError, FallsOffDownwindOfTheBorder) {
  const GridGeometry g(0, 0, 0.01, 100, 50);
  const BorderError east{0, 0.1, 2};
  EXPECT_DOUBLE_EQ(east.at(g, 0, 0.2), 2);
  EXPECT_DOUBLE_EQ(east.at(g, 0.1, 0.2), 2 * std::exp(-1));
  EXPECT_LT(east.at(g, 0.5, 0), 1e-9);
  const BorderError south_west{-0.75 * M_PI, 0.1, 2};
  EXPECT_DOUBLE_EQ(south_west.at(g, 1, 0.5), 2);
  EXPECT_NEAR(south_west.at(g, 1 - 0.1 / std::sqrt(2), 0.25), 2 * std::exp(-1), 1e-9);
  EXPECT_EQ(BorderError{}.at(g, 0, 0), 0);
}

TEST(ForecastEnsemble, ErrorsOfTheMapAndOfTheModelAreInTheSpread) {
  HeightMap start = ripples();
  start.add(layer::variance, 1e-6F);
  ForecastEnsemble::Settings settings = exact();
  // In a calm the map's error is all there is: 400 members tell it to 3.5 %, and neighbours are alike.
  const EnsembleForecast calm = run(settings, start, 400, 0.05);
  EXPECT_NEAR(mean_of(calm.forecasts[1].map.layer(layer::spread)), 1e-3, 3e-5);
  for (std::size_t i = 0; i < start.geometry().size(); ++i)
    EXPECT_NEAR(calm.forecasts[1].map.layer(layer::spread)[i], 1e-3, 2e-4);

  start.remove(layer::variance);
  const double scatter = mean_of(run(settings, start).forecasts[1].map.layer(layer::spread));
  settings.model_error_speed = 1e-3;
  const double with_model = mean_of(run(settings, start).forecasts[1].map.layer(layer::spread));
  EXPECT_GT(with_model, scatter);
  EXPECT_GT(with_model, 1e-3 * std::sqrt(60) * 0.99);
}

TEST(ForecastEnsemble, WhereNothingCanMoveNothingIsSaidToMove) {
  const HeightMap start = ripples();
  ForecastEnsemble::Settings settings;
  settings.model_error_speed = 1e-3;
  const EnsembleForecast calm = run(settings, start, 5, 0.05);
  for (const Forecast& forecast : calm.forecasts) {
    EXPECT_EQ(forecast.map.layer(layer::elevation), start.layer(layer::elevation));
    EXPECT_EQ(forecast.map.layer(layer::spread), HeightMap::Layer(start.geometry().size(), 0.0F));
  }
}

TEST(ForecastEnsemble, MembersNeverLieBelowHardGround) {
  HeightMap start = ripples();
  start.add(layer::variance, 1e-5F);
  start.add(layer::ground, 0.0085F);
  for (float& z : start.layer(layer::elevation)) z = std::max(z, 0.0085F);
  for (const MemberForecast& member : run({}, start).members)
    for (const float z : member.elevation[1]) EXPECT_GE(z, 0.0085F - 1e-7F);
}

TEST(ForecastEnsemble, CoarserMembersTellNearlyTheSameSpread) {
  const HeightMap start = ripples(GridGeometry(0, 0, 0.002, 161, 81));
  ForecastEnsemble::Settings settings = exact();
  const EnsembleForecast fine = run(settings, start);
  settings.member_cell = 0.0041;
  const EnsembleForecast coarse = run(settings, start);
  EXPECT_EQ(coarse.member_geometry, GridGeometry(0, 0, 0.004, 81, 41));
  EXPECT_EQ(coarse.members[0].elevation[0].size(), coarse.member_geometry.size());
  EXPECT_EQ(coarse.forecasts[1].map.geometry(), start.geometry());
  EXPECT_EQ(coarse.forecasts[1].map.layer(layer::elevation), fine.forecasts[1].map.layer(layer::elevation));
  const double expected = mean_of(fine.forecasts[1].map.layer(layer::spread));
  EXPECT_NEAR(mean_of(coarse.forecasts[1].map.layer(layer::spread)), expected, 0.1 * expected);
}

TEST(ForecastEnsemble, UnknownCellsStayUnknown) {
  HeightMap start = ripples();
  for (int y = 10; y < 20; ++y)
    for (int x = 30; x < 45; ++x)
      start.layer(layer::elevation)[start.geometry().index(x, y)] = HeightMap::unknown;
  ForecastEnsemble::Settings settings;
  settings.member_cell = 0.008;
  const EnsembleForecast result = run(settings, start);
  for (std::size_t i = 0; i < start.geometry().size(); ++i)
    EXPECT_EQ(std::isfinite(result.forecasts[1].map.layer(layer::spread)[i]),
              std::isfinite(start.layer(layer::elevation)[i]))
        << i;
}

TEST(ForecastEnsemble, ErrorsOfTheWindAreDrawnAnewForEachForecast) {
  const HeightMap start = ripples();
  EXPECT_EQ(run({}, start).members[0].elevation, run({}, start).members[0].elevation);
  EXPECT_NE(run({}, start).members[0].elevation, run({}, start, 5, 0.45, 1010).members[0].elevation);
  ForecastEnsemble::Settings other;
  other.seed = 2;
  EXPECT_NE(run({}, start).members[0].elevation, run(other, start).members[0].elevation);
}

TEST(ForecastEnsemble, ThreadsDoNotShow) {
  HeightMap start = ripples();
  start.add(layer::variance, 1e-7F);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return run({}, start);
  };
  const EnsembleForecast one = with_threads(1);
  const EnsembleForecast two = with_threads(2);
  for (std::size_t h = 0; h < 2; ++h)
    for (const auto& name : {layer::elevation, layer::spread})
      EXPECT_EQ(one.forecasts[h].map.layer(name), two.forecasts[h].map.layer(name)) << name;
  for (std::size_t m = 0; m < one.members.size(); ++m)
    EXPECT_EQ(one.members[m].elevation, two.members[m].elevation);
}

TEST(ForecastEnsemble, WindThatTurnsIsFollowed) {
  const HeightMap start = ripples();
  std::vector<WindSpell> spells = wind(0.45);
  spells[0].until = 30;
  spells.push_back(wind(0.05)[0]);
  spells[1].until = 60;
  const EnsembleForecast result = ForecastEnsemble({}, {}).run(start, spells, horizons, {}, {});
  const TwinPhysics physics;
  RippleModel model(physics.ripple);
  const auto until_calm = make_forecasts(start, forcing_of(physics, spells[0], {}), {20, 30}, model);
  EXPECT_EQ(result.forecasts[0].map.layer(layer::elevation), until_calm[0].map.layer(layer::elevation));
  EXPECT_EQ(result.forecasts[1].map.layer(layer::elevation), until_calm[1].map.layer(layer::elevation));
}

TEST(ForecastEnsemble, LessSandFromUpwindTakesMoreThanItBrings) {
  const HeightMap start = ripples();
  UncertainParameters starved;
  starved.sand_supply = 0.5;
  EXPECT_LT(plain(start, starved)[1].volume.change, plain(start)[1].volume.change);
  EXPECT_LT(plain(start, starved)[1].volume.inflow, plain(start)[1].volume.inflow);
}

TEST(ForecastEnsemble, RefusesSettingsAndWind) {
  ForecastEnsemble::Settings settings;
  settings.wind_error = 2;
  EXPECT_EQ(error_of([&] { ForecastEnsemble({}, settings); }),
            "ensemble: error of the wind is 2, must be 0 to 1");
  EXPECT_NE(error_of([] { ForecastEnsemble({}, {}).run(ripples(), {}, horizons, {}, {}); }),
            "no error was thrown");
  std::vector<WindSpell> too_short = wind(0.45);
  too_short[0].until = 30;
  EXPECT_NE(error_of([&] {
              ForecastEnsemble({}, {}).run(ripples(), too_short, horizons, {}, {});
            }).find("wind for 30"),
            std::string::npos);
}

}  // namespace
}  // namespace aeolian
