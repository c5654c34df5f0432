// Erosion by parcels on scenes that nobody would choose: ./twin stress
#include <cmath>

#include "bed_scenes.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"

namespace aeolian {
namespace {

/// Winds from none to 40 m/s, steps of 1 us to 1 s, cells of 1 mm to 1 m, spikes, walls, holes, all borders,
/// snow from frost to melting.
TEST(ErosionStress, no_sand_is_lost_and_no_rock_is_dug_into) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    BedScene scene = draw_scene(seed, {seed % 4 == 0, true});
    RandomStream random(seed, 77);
    ErosionParameters p;
    p.border = seed % 2 == 0 ? Border::open : Border::periodic;
    p.inflow = seed % 6 == 0 ? 1 : 0;
    p.flight = seed % 3 == 0 ? FlightMode::hop_table : FlightMode::integrated;
    p.bounce.law = seed % 5 == 0 ? BounceLaw::measured : BounceLaw::attenuated;
    p.bounce.push = seed % 5 < 2;
    p.step = std::pow(10, -6 + 6 * random.uniform());
    if (seed % 7 == 0) {
      p.snow = SnowBonding{};
      p.snow->temperature = -30 + 35 * random.uniform();
      p.snow->snowfall = 1e-4;
    }
    WindField wind;
    wind.friction_velocity = 1.6 * random.uniform();
    wind.direction = scene.forcing.direction;
    scene.map.add(layer::ground);
    HeightMap::Layer& ground = scene.map.layer(layer::ground);
    const HeightMap::Layer start = scene.map.layer(layer::elevation);
    const double depth = seed % 9 == 0 ? 0 : 2 * random.uniform() * random.uniform();
    for (std::size_t i = 0; i < ground.size(); ++i)
      if (random.uniform() < 0.95)
        ground[i] = start[i] - static_cast<float>(random.uniform() < 0.5 ? 0 : depth);
    SCOPED_TRACE(fmt::format("seed {}: {}, u* {:.2f}, step {:.1e}", seed, scene.told(),
                             wind.friction_velocity, p.step));
    ParticleErosion model(p);
    for (int part = 0; part < 2; ++part) {
      const double duration = 300 * std::min(p.acceleration * std::min(p.step, 1e-4), 5e-3);
      const BedChange change = model.advance(scene.map, wind, scene.forcing.grain, duration);
      const HeightMap::Layer& now = scene.map.layer(layer::elevation);
      for (std::size_t i = 0; i < now.size(); ++i) {
        ASSERT_EQ(std::isfinite(start[i]), std::isfinite(now[i])) << "cell " << i;
        if (std::isfinite(now[i]) && std::isfinite(ground[i])) {
          ASSERT_GE(now[i], ground[i]) << "cell " << i << " dug into the ground";
        }
      }
      ASSERT_LE(std::abs(change.volume.error()), 1e-9);
    }
  }
}

TEST(ErosionStress, a_long_run_keeps_every_parcel) {
  HeightMap map(GridGeometry(0, 0, 0.005, 128, 128));
  map.add(layer::elevation, 0.075F);
  map.add(layer::ground, 0);
  ErosionParameters p;
  p.flight = FlightMode::hop_table;
  ParticleErosion model(p);
  WindField wind;
  wind.friction_velocity = 0.4;
  Grain sand;
  sand.diameter = 1.5e-4;
  for (int minute = 0; minute < 5; ++minute) {
    const BedChange change = model.advance(map, wind, sand, 60);
    ASSERT_EQ(change.volume.change, 0);
    ASSERT_EQ(change.volume.error(), 0);
  }
}

}  // namespace
}  // namespace aeolian
