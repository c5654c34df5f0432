#include "aeolian_core/bedforms/sorting/sorted_ripple_model.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sorted_experiments.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"

namespace aeolian {
namespace {

using E = SortedExperiment;

double greatest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

void expect_fractions_in_range(const SortedBed& bed) {
  for (std::size_t i = 0; i < bed.height.size(); ++i) {
    ASSERT_TRUE(std::isfinite(bed.height[i])) << "cell " << i;
    ASSERT_GE(bed.surface_fraction(i), -1e-9) << "cell " << i;
    ASSERT_LE(bed.surface_fraction(i), 1 + 1e-9) << "cell " << i;
    for (const double depth : {1.5, 2.5, 4.0, 30.0}) {
      const double below = bed.fraction_at(i, depth * bed.layers.active);
      ASSERT_TRUE(below >= -1e-6 && below <= 1 + 1e-6) << "cell " << i << ": " << below;
    }
  }
}

/// The greatest difference of height between a bed of two sizes and RippleModel's of one, relative to the
/// latter's rms.
double difference_from_one_size(const GridGeometry& g, const SortedRippleParameters& p,
                                const SortedForcing& forcing, bool coarse, double duration) {
  std::vector<double> one = rough_bed(g, 3e-5);
  SortedBed two(g, one, p.layers());
  RippleModel(p.ripples).advance(g, one, coarse ? forcing.coarse : forcing.fine, duration);
  SortedRippleModel(p).advance(two, forcing, duration);
  double square = 0;
  for (const double h : one) square += h * h / static_cast<double>(one.size());
  for (std::size_t i = 0; i < g.size(); ++i)
    EXPECT_NEAR(two.surface_fraction(i), p.coarse_fraction, 1e-9);  // strata are floats
  return greatest_difference(one, two.height) / std::sqrt(square);
}

TEST(SortedRippleModelTest, two_sizes_alike_are_one) {
  const GridGeometry g(0, 0, 0.002, 100, 60);
  for (const Border border : {Border::periodic, Border::open})
    for (const double direction : {0.0, 0.5, 2.5}) {
      SortedRippleParameters p = E::parameters(border);
      p.coarse_diameter = E::fine().grain.diameter;
      p.active_layer = 50;  // thick enough not to shorten steps
      const SortedForcing forcing = sorted_forcing(E::fine(direction), p.coarse_diameter);
      EXPECT_LT(difference_from_one_size(g, p, forcing, false, E::unit_time), 1e-9) << direction;
      // At steep brinks RippleModel may take up more than lies there, which no size here can.
      EXPECT_LT(difference_from_one_size(g, p, forcing, false, 5 * E::unit_time), 0.03) << direction;
    }
}

TEST(SortedRippleModelTest, impacts_of_several_angles_strike_two_sizes_as_one) {
  const GridGeometry g(0, 0, 0.002, 100, 60);
  SortedRippleParameters p = E::parameters();
  p.coarse_diameter = E::fine().grain.diameter;
  p.active_layer = 50;
  Forcing fine = E::fine(0.5);
  fine.impact_angle_spread = 0.07;
  const SortedForcing forcing = sorted_forcing(fine, p.coarse_diameter);
  EXPECT_LT(difference_from_one_size(g, p, forcing, false, E::unit_time), 1e-9);
}

TEST(SortedRippleModelTest, a_bed_of_one_of_the_sizes_behaves_as_that_size) {
  const GridGeometry g(0, 0, 0.0005, 200, 40);
  for (const double fraction : {0.0, 1.0}) {
    SortedRippleParameters p = E::parameters();
    p.coarse_fraction = fraction;
    p.active_layer = 50;
    const double difference =
        difference_from_one_size(g, p, E::forcing(0.5), fraction == 1, 0.1 * E::unit_time);
    EXPECT_LT(difference, 1e-6) << fraction;
  }
}

TEST(SortedRippleModelTest, waves_grow_at_the_mean_rate_of_the_sizes_while_composition_stays) {
  for (const double hops : {4.0, 8.0, 16.0})
    for (const double fraction : {0.0, 0.2, 0.5, 1.0}) {
      const WaveGrowth wave = growth_of_a_sorted_wave(hops, 1e7, fraction);
      EXPECT_NEAR(wave.model.real() / wave.theory.real(), 1, 0.01) << hops << ' ' << fraction;
      EXPECT_NEAR(wave.model.imag() / wave.theory.imag(), 1, 0.01) << hops << ' ' << fraction;
    }
}

TEST(SortedRippleModelTest, waves_of_height_and_composition_grow_together_as_theory_says) {
  for (const double hops : {4.0, 8.0, 16.0})
    for (const double layer : {2.0, 20.0}) {
      const WaveGrowth wave = growth_of_a_sorted_wave(hops, layer, 0.3);
      EXPECT_NEAR(wave.model.real() / wave.theory.real(), 1, 0.01) << hops << ' ' << layer;
      EXPECT_NEAR(wave.model.imag() / wave.theory.imag(), 1, 0.01) << hops << ' ' << layer;
    }
}

TEST(SortedRippleModelTest, volume_of_each_size_is_conserved_over_hours_of_turning_wind) {
  const GridGeometry g(0, 0, 0.002, 64, 48);
  SortedRippleParameters p = E::parameters();
  p.strata = 3;  // so that old deposits are mixed and come up again
  SortedBed bed(g, rough_bed(g, 1e-3), p.layers());
  const double volume = bed.volume();
  const double coarse = bed.coarse_volume();
  double moved = 0;
  for (int n = 0; n < 30; ++n)
    moved += SortedRippleModel(p).advance(bed, E::forcing(0.7 * n), 60).coarse.moved;
  EXPECT_GT(moved, 1e-4);
  EXPECT_LT(std::abs(bed.volume() - volume), 1e-12 * moved);
  EXPECT_LT(std::abs(bed.coarse_volume() - coarse), 1e-12 * moved);
  expect_fractions_in_range(bed);
}

TEST(SortedRippleModelTest, what_crosses_open_borders_is_booked_for_each_size) {
  const GridGeometry g(0, 0, 0.002, 64, 48);
  for (const double direction : {0.0, 0.6, 4.0}) {
    SortedRippleParameters p = E::parameters(Border::open);
    SortedBed bed(g, rough_bed(g, 1e-3), p.layers());
    const SortedChange change = SortedRippleModel(p).advance(bed, E::forcing(direction), 300);
    EXPECT_GT(change.coarse.inflow, 0);
    EXPECT_LT(std::abs(change.fine.error()), 1e-12);
    EXPECT_LT(std::abs(change.coarse.error()), 1e-12);
  }
}

TEST(SortedRippleModelTest, coarse_grains_gather_on_crests_whatever_the_wind_is) {
  // Anderson & Bunas (1993), Manukyan & Prigozhin (2009).
  const GridGeometry g(0, 0, 0.002, 120, 100);
  for (const double direction : {0.0, 0.5, 0.785}) {
    SortedRippleParameters p = E::parameters();
    SortedBed bed(g, rough_bed(g, 3e-4), p.layers());
    const SortedRippleModel model(p);
    double before = 0.02;
    for (int n = 0; n < 3; ++n) {
      model.advance(bed, E::forcing(direction), 120);
      EXPECT_GT(crest_enrichment(bed), before) << direction << ' ' << n;
      before = crest_enrichment(bed);
    }
    expect_fractions_in_range(bed);
  }
}

TEST(SortedRippleModelTest, a_flat_bed_without_supply_is_armoured_as_a_mixed_layer_is) {
  for (const double mobility : {0.0, 0.2, 2.0}) {
    const auto flux = [&](double fraction) { return 1 - fraction + mobility * fraction; };
    double before = flux(E::coarse_fraction);
    for (const double time : {5.0, 20.0, 100.0, 1000.0}) {
      const SortedBed bed = armoured_bed(mobility, time);
      const double expected = armoured_fraction(E::erosion_rate, mobility * E::erosion_rate,
                                                E::coarse_fraction, bed.layers.active, time);
      EXPECT_NEAR(bed.surface_fraction(9), expected, 0.007) << mobility << ' ' << time;
      EXPECT_LE(flux(bed.surface_fraction(9)), before + 1e-12) << mobility << ' ' << time;
      before = flux(bed.surface_fraction(9));
    }
  }
  const double exact = armoured_fraction(E::erosion_rate, 0, E::coarse_fraction, 0.001, 20);
  EXPECT_LT(std::abs(armoured_bed(0, 20, 0.05).surface_fraction(9) - exact), 5e-4);
}

TEST(SortedRippleModelTest, cells_of_a_grain_to_a_metre_and_durations_over_decades_are_stable) {
  for (const double cell : {0.0003, 0.002, 0.05, 1.0})
    for (const double duration : {1e-3, 1.0, 100.0, 3000.0})
      for (const Border border : {Border::periodic, Border::open}) {
        if (cell < 0.001 && duration > 100) continue;  // a hundred thousand steps
        const GridGeometry g(0, 0, cell, 24, 10);
        std::vector<double> h = rough_bed(g, 0.3 * cell);
        h[37] += 20 * cell;
        h[101] -= 20 * cell;
        for (int y = 0; y < g.ny(); ++y) h[g.index(12, y)] += 10 * cell;
        const SortedRippleParameters p = E::parameters(border);
        SortedBed bed(g, h, p.layers());
        const SortedChange change = SortedRippleModel(p).advance(bed, E::forcing(0.4), duration);
        expect_fractions_in_range(bed);
        const double rounding = 1e-15 * std::abs(h[37]) * static_cast<double>(g.size()) * cell * cell;
        for (const VolumeBalance& v : {change.fine, change.coarse})
          EXPECT_LT(std::abs(v.error()) * v.moved, 1e-9 * v.moved + rounding) << cell << ' ' << duration;
      }
}

/// The greatest difference of height between two sizes that are alike and RippleModel's one on a bed,
/// relative to how much that changes it.
double difference_of_sizes_alike(const GridGeometry& g, const std::vector<double>& start, double direction,
                                 double duration) {
  SortedRippleParameters p = E::parameters();
  p.coarse_diameter = E::fine().grain.diameter;
  p.active_layer = 1e4;  // thick enough not to shorten steps
  SortedBed two(g, start, p.layers());
  std::vector<double> one = start;
  SortedRippleModel(p).advance(two, sorted_forcing(E::fine(direction), p.coarse_diameter), duration);
  RippleModel(p.ripples).advance(g, one, E::fine(direction), duration);
  return greatest_difference(one, two.height) / greatest_difference(one, start);
}

TEST(SortedRippleModelTest, what_is_steeper_than_repose_slides_before_impacts_see_it) {
  const GridGeometry g(0, 0, 0.08, 50, 22);
  EXPECT_LT(difference_of_sizes_alike(g, rough_bed(g, 0.5), 1.2, 50), 1e-3);
}

TEST(SortedRippleModelTest, hops_shorter_than_cells_end_on_slopes_at_repose_as_those_of_one_size) {
  const GridGeometry g(0, 0, 0.8, 100, 4);
  std::vector<double> ridges(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) ridges[g.index(x, y)] = 0.4 * std::abs(x % 20 - 10);
  EXPECT_LT(difference_of_sizes_alike(g, ridges, 0, 1e5), 0.05);
}

TEST(SortedRippleModelTest, the_bits_are_the_same_for_any_number_of_threads) {
  const GridGeometry g(0, 0, 0.002, 150, 300);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    SortedBed bed(g, rough_bed(g, 2e-3), E::parameters().layers());
    SortedRippleModel(E::parameters()).advance(bed, E::forcing(0.3), 20);
    return bed;
  };
  const SortedBed one = run(1);
  const SortedBed two = run(2);
  EXPECT_EQ(one.height, two.height);
  EXPECT_EQ(one.coarse, two.coarse);
  EXPECT_EQ(one.upper_coarse, two.upper_coarse);
}

HeightMap sandy_map(int nx, int ny) {
  HeightMap map(GridGeometry(0, 0, 0.002, nx, ny));
  const std::vector<double> h = rough_bed(map.geometry(), 5e-4);
  map.add(layer::elevation, HeightMap::Layer(h.begin(), h.end()));
  return map;
}

TEST(SortedRippleModelTest, a_map_as_it_was_left_loses_nothing_over_many_calls) {
  HeightMap map = sandy_map(50, 40);
  SortedRippleModel model(E::parameters());
  model.advance(map, E::fine(), 1);
  const double volume = model.bed()->volume();
  const double coarse = model.bed()->coarse_volume();
  double moved = 0;
  for (int n = 0; n < 60; ++n) moved += model.advance(map, E::fine(0.1 * n), 1).volume.moved;
  EXPECT_LT(std::abs(model.bed()->volume() - volume), 1e-12 * moved);
  EXPECT_LT(std::abs(model.bed()->coarse_volume() - coarse), 1e-12 * moved);
  for (std::size_t i = 0; i < map.geometry().size(); ++i)
    ASSERT_EQ(map.layer(layer::elevation)[i], static_cast<float>(model.bed()->height[i]));
}

TEST(SortedRippleModelTest, a_map_file_goes_on_as_the_map_would_have) {
  HeightMap map = sandy_map(50, 40);
  SortedRippleModel model(E::parameters(Border::open));
  model.advance(map, E::fine(), 120);
  const std::string path = testing::TempDir() + "sorted.tif";
  write_geotiff(map, path);
  HeightMap read = read_geotiff(path);
  ASSERT_TRUE(read.has(layer::coarse_fraction));
  model.advance(map, E::fine(), 60);
  SortedRippleModel(E::parameters(Border::open)).advance(read, E::fine(), 60);
  for (const std::string& name : {layer::elevation, layer::coarse_fraction, layer::coarse_fraction + "_2"})
    for (std::size_t i = 0; i < map.geometry().size(); ++i)
      ASSERT_NEAR(map.layer(name)[i], read.layer(name)[i], name == layer::elevation ? 1e-6 : 2e-3)
          << name << ' ' << i;
}

TEST(SortedRippleModelTest, unknown_cells_stay_unknown_and_the_known_stay_known) {
  HeightMap map = sandy_map(50, 40);
  HeightMap::Layer& h = map.layer(layer::elevation);
  for (std::size_t i = 300; i < 320; ++i) h[i] = HeightMap::unknown;
  SortedRippleModel(E::parameters(Border::open)).advance(map, E::fine(), 60);
  for (std::size_t i = 0; i < h.size(); ++i) {
    ASSERT_EQ(std::isnan(h[i]), i >= 300 && i < 320) << i;
    ASSERT_EQ(std::isnan(map.layer(layer::coarse_fraction)[i]), i >= 300 && i < 320) << i;
    ASSERT_EQ(std::isnan(map.layer(layer::roughness)[i]), i >= 300 && i < 320) << i;
  }
}

TEST(SortedRippleModelTest, calm_leaves_the_map_bit_for_bit) {
  HeightMap map = sandy_map(20, 20);
  const HeightMap::Layer before = map.layer(layer::elevation);
  Forcing calm = E::fine();
  calm.ejection_rate = 0;
  EXPECT_EQ(SortedRippleModel(E::parameters()).advance(map, calm, 100).active.count(), 0);
  EXPECT_EQ(map.layer(layer::elevation), before);
  EXPECT_EQ(map.names(), std::vector<std::string>{layer::elevation});
}

TEST(SortedRippleModelTest, bad_input_is_refused) {
  const auto with = [](auto&& change) {
    SortedRippleParameters p;
    change(p);
    return p;
  };
  for (const SortedRippleParameters& p :
       {with([](auto& q) { q.coarse_diameter = 0; }), with([](auto& q) { q.coarse_fraction = 1.2; }),
        with([](auto& q) { q.coarse_fraction = -0.1; }), with([](auto& q) { q.active_layer = 0.1; }),
        with([](auto& q) { q.active_layer = std::numeric_limits<double>::quiet_NaN(); }),
        with([](auto& q) { q.stratum = 0; }), with([](auto& q) { q.strata = 0; }),
        with([](auto& q) { q.strata = 1000; }), with([](auto& q) { q.ripples.stochastic_share = 0.1; }),
        with([](auto& q) { q.ripples.wavelength_law = make_wavelength_law("constant", 250); }),
        with([](auto& q) { q.ripples.inflow = Inflow::ripples; }), with([](auto& q) { q.ripples.step = 0; })})
    EXPECT_THROW(SortedRippleModel model(p), Error);

  SortedRippleModel model(E::parameters(Border::open));
  HeightMap map = sandy_map(20, 20);
  Forcing too_coarse = E::fine();
  too_coarse.grain.diameter = 2 * E::coarse_diameter;
  EXPECT_THROW(model.advance(map, too_coarse, 1), Error);
  map.add(layer::coarse_fraction, 1.5F);
  EXPECT_THROW(model.advance(map, E::fine(), 1), Error);
  map.add(layer::coarse_fraction, 0.5F);
  map.add(layer::ground, -0.1F);
  EXPECT_THROW(model.advance(map, E::fine(), 1), Error);
}

}  // namespace
}  // namespace aeolian
