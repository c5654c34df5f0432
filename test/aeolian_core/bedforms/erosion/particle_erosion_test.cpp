#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"

#include <cmath>
#include <limits>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/erosion/launcher.hpp"
#include "aeolian_core/bedforms/erosion/snow_cover.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

Grain sand() {
  Grain grain;
  grain.diameter = 1.5e-4;
  grain.angle_of_repose = 34 * M_PI / 180;
  return grain;
}

/// Sand of 3 cm on a floor, uneven by a grain.
HeightMap sand_bed(int nx, int ny) {
  HeightMap map(GridGeometry(0, 0, 0.005, nx, ny));
  RandomStream random(3, 0);
  for (float& h : map.add(layer::elevation, 0)) h = static_cast<float>(0.03 + 3e-4 * random.uniform());
  map.add(layer::ground, 0);
  return map;
}

WindField wind_of(double friction_velocity, double direction = 0) {
  WindField wind;
  wind.friction_velocity = friction_velocity;
  wind.direction = direction;
  return wind;
}

double volume(const HeightMap& map) {
  double sum = 0;
  for (const float h : map.layer(layer::elevation)) sum += std::isfinite(h) ? h : 0;
  return sum * map.geometry().cell() * map.geometry().cell();
}

double deviation(const HeightMap& map) {
  double sum = 0, squares = 0;
  for (const float h : map.layer(layer::elevation)) {
    sum += h;
    squares += static_cast<double>(h) * h;
  }
  const double n = static_cast<double>(map.layer(layer::elevation).size());
  return std::sqrt(std::max(0.0, squares / n - sum * sum / n / n));
}

class AnyFlight : public testing::TestWithParam<FlightMode> {
 protected:
  static ErosionParameters parameters() {
    ErosionParameters p;
    p.flight = GetParam();
    return p;
  }
};

TEST_P(AnyFlight, up_to_the_threshold_the_map_is_left_bit_for_bit) {
  HeightMap map = sand_bed(64, 64);
  map.layer(layer::elevation)[100] += 0.5F;  // a spike that would slide if anything were done
  const HeightMap::Layer before = map.layer(layer::elevation);
  ParticleErosion model(parameters());
  const BedChange change = model.advance(map, wind_of(0.243), sand(), 3600);
  EXPECT_EQ(map.layer(layer::elevation), before);
  EXPECT_TRUE(change.active.empty());
  EXPECT_EQ(change.volume.moved, 0);
  EXPECT_EQ(model.counts().steps, 0);
}

TEST_P(AnyFlight, nothing_is_lost) {
  HeightMap map = sand_bed(64, 48);
  const double before = volume(map);
  ParticleErosion model(parameters());
  for (int n = 0; n < 5; ++n) {
    const BedChange change = model.advance(map, wind_of(0.4, 0.3 * n), sand(), 4);
    EXPECT_GT(change.volume.moved, 0);
    EXPECT_EQ(change.volume.change, 0);
    EXPECT_EQ(change.volume.error(), 0);
    EXPECT_FALSE(change.active.empty());
  }
  EXPECT_NEAR(volume(map) + model.airborne_volume(), before, 1e-7 * before);  // floats
}

TEST_P(AnyFlight, over_open_borders_what_leaves_is_counted) {
  HeightMap map = sand_bed(64, 48);
  ErosionParameters p = parameters();
  p.border = Border::open;
  p.inflow = 1;
  p.bounce.push = true;
  ParticleErosion model(p);
  BedChange change;
  for (int n = 0; n < 5; ++n) {
    change = model.advance(map, wind_of(0.4), sand(), 5);
    EXPECT_LT(std::abs(change.volume.error()), 1e-12);
  }
  EXPECT_GT(change.volume.outflow, 0);
  EXPECT_GT(change.volume.inflow, 0);
}

TEST_P(AnyFlight, threads_do_not_change_a_bit) {
  HeightMap one = sand_bed(96, 96);
  HeightMap many = one;
  ErosionParameters p = parameters();
  p.bounce.push = true;
  ParticleErosion first(p), second(p);
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    first.advance(one, wind_of(0.4), sand(), 2);
  }
  second.advance(many, wind_of(0.4), sand(), 2);
  EXPECT_EQ(one.layer(layer::elevation), many.layer(layer::elevation));
  EXPECT_GT(first.counts().launches, 100);
}

TEST_P(AnyFlight, bare_ground_gives_nothing_and_a_thin_cover_is_not_dug_through) {
  HeightMap map = sand_bed(64, 64);
  map.layer(layer::ground) = map.layer(layer::elevation);
  const HeightMap::Layer rock = map.layer(layer::ground);
  ParticleErosion bare(parameters());
  EXPECT_EQ(bare.advance(map, wind_of(0.5), sand(), 100).volume.moved, 0);
  EXPECT_EQ(map.layer(layer::elevation), rock);
  for (std::size_t i = 0; i < rock.size(); i += 3) map.layer(layer::elevation)[i] += 3e-4F;
  ParticleErosion thin(parameters());
  thin.advance(map, wind_of(0.5), sand(), 30);
  for (std::size_t i = 0; i < rock.size(); ++i) ASSERT_GE(map.layer(layer::elevation)[i], rock[i]);
}

TEST_P(AnyFlight, the_flux_is_the_saturated_one) {
  for (const double u : {0.28, 0.42}) {
    HeightMap map = sand_bed(64, 64);
    ParticleErosion model(parameters());
    model.advance(map, wind_of(u), sand(), 10);
    const double before = model.counts().transported;
    model.advance(map, wind_of(u), sand(), 10);
    const double area = 0.32 * 0.32;
    const double flux = (model.counts().transported - before) / 10 / area;
    const double law = 5 * 1.225 / 9.81 * 0.8 * 0.2434 * (u * u - std::pow(0.8 * 0.2434, 2)) / (2650 * 0.6);
    EXPECT_GT(flux, law / 1.5) << u;
    EXPECT_LT(flux, law * 1.5) << u;
  }
}

TEST_P(AnyFlight, a_wind_turned_by_a_right_angle_does_the_same_turned) {
  HeightMap east = sand_bed(96, 96);
  HeightMap north = east;
  ParticleErosion first(parameters()), second(parameters());
  first.advance(east, wind_of(0.4), sand(), 10);
  second.advance(north, wind_of(0.4, M_PI / 2), sand(), 10);
  EXPECT_NEAR(deviation(north), deviation(east), 0.1 * deviation(east));
  EXPECT_GT(deviation(east), 1.5e-4);
}

TEST_P(AnyFlight, one_run_is_two_halves) {
  HeightMap whole = sand_bed(64, 64);
  HeightMap halves = whole;
  ErosionParameters p = parameters();
  ParticleErosion first(p), second(p);
  first.advance(whole, wind_of(0.4), sand(), 10);
  second.advance(halves, wind_of(0.4), sand(), 5);
  second.advance(halves, wind_of(0.4), sand(), 5);
  EXPECT_NEAR(static_cast<double>(second.counts().launches), static_cast<double>(first.counts().launches),
              0.1 * static_cast<double>(first.counts().launches));
}

TEST_P(AnyFlight, holes_stay_holes) {
  HeightMap map = sand_bed(64, 64);
  for (int y = 20; y < 30; ++y)
    for (int x = 20; x < 30; ++x)
      map.layer(layer::elevation)[map.geometry().index(x, y)] = HeightMap::unknown;
  ParticleErosion model(parameters());
  const BedChange change = model.advance(map, wind_of(0.4), sand(), 10);
  EXPECT_EQ(count_known(map.layer(layer::elevation)), 64U * 64 - 100);
  EXPECT_GT(change.volume.outflow, 0);
  EXPECT_LT(std::abs(change.volume.error()), 1e-12);
}

TEST_P(AnyFlight, a_wind_of_cells_moves_only_what_it_reaches) {
  HeightMap map = sand_bed(128, 32);
  const HeightMap::Layer before = map.layer(layer::elevation);
  WindField wind = wind_of(0.1);
  wind.cells = HeightMap(map.geometry());
  HeightMap::Layer& u = wind.cells.add("friction_velocity", 0.1F);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) u[map.geometry().index(x, y)] = 0.45F;
  ParticleErosion model(parameters());
  EXPECT_GT(model.advance(map, wind, sand(), 10).volume.moved, 0);
  for (int y = 0; y < 32; ++y) {
    const std::size_t i = map.geometry().index(100, y);
    EXPECT_GE(map.layer(layer::elevation)[i], before[i]) << "eroded where it is calm";
  }
}

INSTANTIATE_TEST_SUITE_P(ParticleErosion, AnyFlight,
                         testing::Values(FlightMode::integrated, FlightMode::hop_table),
                         [](const auto& mode) {
                           return mode.param == FlightMode::integrated ? "integrated" : "hop_table";
                         });

TEST(Launcher, nothing_leaves_in_the_lee) {
  HeightMap map(GridGeometry(0, 0, 0.005, 200, 32));
  HeightMap::Layer& height = map.add(layer::elevation, 0);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 200; ++x)
      height[map.geometry().index(x, y)] =
          static_cast<float>(std::max(0.0, 0.03 * std::exp(-std::pow((x - 100) / 8.0, 2)) - 1e-4));
  const ErodibleBed bed(map, 1.5e-4, true);
  for (const Shelter shelter : {Shelter::ray, Shelter::slope}) {
    ErosionParameters p;
    p.shelter = shelter;
    const Grain grain = sand();
    const Drift drift(wind_of(0.4), bed, grain, p);
    const Launcher launcher(p, grain, bed, drift, nullptr);
    EXPECT_GT(launcher.chance({20, 5}), 0);
    EXPECT_GT(launcher.chance({96, 5}), 0);
    for (int x = 104; x < 114; ++x) EXPECT_EQ(launcher.chance({x, 5}), 0) << x;
    // Level ground behind the hump: rays do not reach it, the slope alone cannot know.
    EXPECT_EQ(launcher.chance({123, 5}) > 0, shelter == Shelter::slope);
  }
}

TEST(Launcher, impacts_lower_the_threshold_of_loose_grains_only) {
  HeightMap map(GridGeometry(0, 0, 0.02, 32, 32));
  map.add(layer::elevation, 0.02F);
  map.add(layer::ground, 0);
  map.add("sintered", 0);
  map.layer("sintered")[map.geometry().index(3, 3)] = 0.02F;
  ErosionParameters p;
  p.snow = SnowBonding{};
  p.snow->edge = 0;
  p.air.density = 1.3;
  const ErodibleBed bed(map, 2e-4, true);
  SnowCover snow(*p.snow, bed);
  const Grain grain = drifting_snow();
  const auto lifts = [&](double friction, int x, bool impacts) {
    const Drift drift(wind_of(friction), bed, grain, p);
    Launcher launcher(p, grain, bed, drift, &snow);
    launcher.set_impacts(impacts);
    return launcher.chance({x, 3}) > 0;
  };
  for (int x = 0; x < 32; ++x) snow.set_age(map.geometry().index(x, 3), 60);  // threshold 0.337 m/s
  EXPECT_FALSE(lifts(0.30, 20, false));
  EXPECT_TRUE(lifts(0.30, 20, true));
  EXPECT_FALSE(lifts(0.60, 3, true));
  EXPECT_TRUE(lifts(0.70, 3, false));
}

TEST(Snow, drift_keeps_its_surface_fresh_where_undisturbed_snow_has_bonded) {
  ErosionParameters p;
  p.flight = FlightMode::hop_table;
  p.snow = SnowBonding{};
  p.air.density = 1.3;
  p.roughness = 1e-4;
  p.parcel_thickness = 1e-3;
  HeightMap blown = sand_bed(32, 32);
  ParticleErosion drifting(p);
  drifting.advance(blown, wind_of(0.35), drifting_snow(), 600);
  EXPECT_GT(drifting.advance(blown, wind_of(0.35), drifting_snow(), 60).volume.moved, 0);
  p.snow->initial_age = 600;
  HeightMap calm = sand_bed(32, 32);
  ParticleErosion bonded(p);
  EXPECT_EQ(bonded.advance(calm, wind_of(0.35), drifting_snow(), 60).volume.moved, 0);
}

TEST(Snow, sintered_snow_goes_only_at_edges_and_only_above_its_threshold) {
  HeightMap map(GridGeometry(0, 0, 0.02, 128, 32));
  HeightMap::Layer& height = map.add(layer::elevation, 0);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 128; ++x) height[map.geometry().index(x, y)] = x < 64 ? 0.02F : 0.07F;
  map.add(layer::ground, 0);
  map.add("sintered", height);
  ErosionParameters p;
  p.snow = SnowBonding{};
  p.air.density = 1.3;
  p.border = Border::open;
  ParticleErosion calm(p);
  const HeightMap::Layer before = height;
  calm.advance(map, wind_of(0.6), drifting_snow(), 600);
  EXPECT_EQ(map.layer(layer::elevation), before);
  ParticleErosion storm(p);
  storm.advance(map, wind_of(0.9), drifting_snow(), 120);
  int at_edge = 0, elsewhere = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 128; ++x) {
      const std::size_t i = map.geometry().index(x, y);
      if (map.layer(layer::elevation)[i] < before[i] - 1e-4F) ++(std::abs(x - 66) < 12 ? at_edge : elsewhere);
    }
  EXPECT_GT(at_edge, 5);
  EXPECT_LT(elsewhere, at_edge / 10 + 1);
}

TEST(Snow, melting_freezes_the_pattern) {
  HeightMap map = sand_bed(64, 64);
  const double volume_before = volume(map);
  ErosionParameters p;
  p.snow = SnowBonding{};
  p.snow->temperature = 1;
  ParticleErosion model(p);
  model.advance(map, wind_of(0.6), drifting_snow(), 1);
  model.advance(map, wind_of(0.6), drifting_snow(), 600);
  EXPECT_NEAR(volume(map) + model.airborne_volume(), volume_before, 1e-6 * volume_before);
  HeightMap frozen = map;
  model.advance(map, wind_of(0.8), drifting_snow(), 600);
  EXPECT_EQ(map.layer(layer::elevation), frozen.layer(layer::elevation));
}

TEST(ParticleErosion, bad_input_is_told_in_one_line) {
  ErosionParameters p;
  p.step = 2;
  EXPECT_EQ(error_of([&] { ParticleErosion model(p); }), "erosion: step is 2, must be 1e-6 to 1 s");
  p = {};
  p.lift_off.least_angle = 0;
  EXPECT_NE(error_of([&] { ParticleErosion model(p); }).find("least lift-off angle is 0"), std::string::npos);
  p = {};
  p.snow = SnowBonding{};
  p.snow->temperature = 100;
  EXPECT_NE(error_of([&] { ParticleErosion model(p); }).find("temperature is 100"), std::string::npos);

  ParticleErosion model(ErosionParameters{});
  HeightMap map = sand_bed(32, 32);
  EXPECT_NE(error_of([&] { model.advance(map, wind_of(-1), sand(), 1); }).find("friction velocity is -1"),
            std::string::npos);
  EXPECT_NE(error_of([&] { model.advance(map, wind_of(0.3), sand(), -1); }).find("duration is -1"),
            std::string::npos);
  EXPECT_NE(error_of([&] { model.advance(map, wind_of(0.3), sand(), std::nan("")); }).find("duration"),
            std::string::npos);
  map.add(layer::elevation);
  EXPECT_NE(error_of([&] { model.advance(map, wind_of(0.3), sand(), 1); }).find("no known cell"),
            std::string::npos);
}

}  // namespace
}  // namespace aeolian
