#include "aeolian_core/bedforms/sorting/sorted_bed.hpp"

#include <cmath>
#include <vector>

#include "sorted_experiments.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/bedforms/height_map/avalanche.hpp"
#include "aeolian_core/bedforms/height_map/slope_flux.hpp"
#include "aeolian_core/bedforms/sorting/active_layer.hpp"
#include "aeolian_core/bedforms/sorting/sorted_avalanche.hpp"
#include "aeolian_core/bedforms/sorting/sorted_slope_flux.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

TEST(StrataTest, what_is_buried_comes_back_last_in_first_out) {
  Strata strata(2, 4, 0.5, 0.2);
  for (const float coarse : {0.1F, 0.2F, 0.3F}) strata.bury(1, coarse);
  EXPECT_DOUBLE_EQ(strata.fraction(1, 0), static_cast<double>(0.3F) / 0.5);
  EXPECT_DOUBLE_EQ(strata.fraction(1, 3), 0.2);
  EXPECT_DOUBLE_EQ(strata.unearth(1), static_cast<double>(0.3F));
  EXPECT_DOUBLE_EQ(strata.unearth(1), static_cast<double>(0.2F));
  EXPECT_DOUBLE_EQ(strata.unearth(1), static_cast<double>(0.1F));
  EXPECT_DOUBLE_EQ(strata.unearth(1), 0.1);  // the bulk
  EXPECT_DOUBLE_EQ(strata.unearth(0), 0.1);
}

TEST(StrataTest, more_than_is_remembered_is_mixed_and_not_lost) {
  Strata strata(1, 2, 0.5, 0.2);
  double buried = 0;
  for (int n = 0; n < 7; ++n) {
    strata.bury(0, 0.0625F * static_cast<float>(n));
    buried += 0.0625 * n;
  }
  EXPECT_NEAR(strata.excess(0), buried - 7 * 0.1, 1e-15);
  EXPECT_NEAR(strata.fraction(0, 2), 0.0625 * (0 + 1 + 2 + 3 + 4) / 5 / 0.5, 1e-15);
  double unearthed = 0;
  for (int n = 0; n < 7; ++n) unearthed += strata.unearth(0);
  EXPECT_NEAR(unearthed, buried, 1e-15);
  EXPECT_NEAR(strata.excess(0), 0, 1e-15);
}

TEST(SortedBedTest, strata_end_at_multiples_of_their_thickness) {
  const GridGeometry g(0, 0, 0.01, 4, 1);
  const BedLayers layers{0.001, 0.0005, 8, 0.3};
  const SortedBed bed(g, {0.0, 0.0012, -0.0031, 1200.00037}, layers);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(bed.upper[i], 0);
    EXPECT_LE(bed.upper[i], layers.stratum);
    const double end = (bed.height[i] - layers.active - bed.upper[i]) / layers.stratum;
    EXPECT_NEAR(end, std::round(end), 1e-6);
  }
  EXPECT_NEAR(bed.coarse_volume(), 0.3 * bed.volume(), 1e-12 * bed.volume());
}

TEST(SortedBedTest, composition_survives_a_map) {
  HeightMap map(GridGeometry(0, 0, 0.002, 30, 20));
  const SortedRippleParameters p = SortedExperiment::parameters();
  SortedBed bed(map.geometry(), rough_bed(map.geometry(), 1e-3), p.layers());
  SortedRippleModel(p).advance(bed, SortedExperiment::forcing(), 200);
  map.add(layer::elevation, HeightMap::Layer(bed.height.begin(), bed.height.end()));
  bed.write_composition(map);
  const SortedBed read(map, p.layers());
  for (std::size_t i = 0; i < bed.height.size(); ++i) {
    ASSERT_NEAR(read.surface_fraction(i), bed.surface_fraction(i), 1e-6);
    for (int k = 0; k < p.strata - 1; ++k)
      ASSERT_NEAR(read.strata.fraction(i, k), bed.strata.fraction(i, k), 1e-6) << i << ' ' << k;
  }
  EXPECT_NEAR(read.coarse_volume(), bed.coarse_volume(), 1e-5 * 600 * 4e-6 * p.layers().active);
}

TEST(SortedBedTest, bad_layers_are_refused) {
  const GridGeometry g(0, 0, 0.01, 2, 1);
  const BedLayers good;
  BedLayers bad = good;
  bad.active = 0;
  EXPECT_THROW(SortedBed(g, {0, 0}, bad), Error);
  bad = good;
  bad.bulk = 1.01;
  EXPECT_THROW(SortedBed(g, {0, 0}, bad), Error);
  bad = good;
  bad.remembered = 65;
  EXPECT_THROW(SortedBed(g, {0, 0}, bad), Error);
  EXPECT_THROW(SortedBed(g, {0}, good), Error);
  EXPECT_THROW(SortedBed(g, {0, NAN}, good), Error);
}

/// A bed whose surface has any composition.
SortedBed spotted_bed(const GridGeometry& g, double deviation) {
  SortedBed bed(g, rough_bed(g, deviation), SortedExperiment::parameters().layers());
  RandomStream random(3, 0);
  for (double& c : bed.coarse) c = bed.layers.active * random.uniform();
  return bed;
}

TEST(ActiveLayerTest, what_is_dug_and_given_settles_without_loss) {
  const GridGeometry g(0, 0, 0.002, 12, 9);
  SortedBed bed = spotted_bed(g, 1e-3);
  const double before = bed.coarse_volume();
  const WindFrame frame(g, 2.0, false);
  ActiveLayer layer(frame, bed);
  FrameField height;
  frame.enter(bed.height, height);
  // Thin and thick slides, some through many strata.
  int n = 0;
  for (const double amount : {1e-5, 3e-4, 2e-3, 0.017, 0.9}) {
    const int i = n % frame.stations();
    layer.give(i, 1, (i + 3) % frame.stations(), 4, amount);
    height.at(i)[1] -= amount;
    height.at((i + 3) % frame.stations())[4] += amount;
    ++n;
    layer.settle();
  }
  frame.leave(height, bed.height);
  layer.leave();
  EXPECT_NEAR(bed.coarse_volume(), before, 1e-15);
  for (std::size_t c = 0; c < bed.height.size(); ++c) {
    EXPECT_GE(bed.surface_fraction(c), 0);
    EXPECT_LE(bed.surface_fraction(c), 1 + 1e-12);
    EXPECT_GT(bed.upper[c], 0);
    EXPECT_LE(bed.upper[c], bed.layers.stratum * (1 + 1e-9));
  }
}

TEST(SortedSlopeFluxTest, heights_are_those_of_the_slope_flux) {
  const GridGeometry g(0, 0, 0.002, 40, 37);
  for (const bool periodic : {true, false})
    for (const double duration : {0.01, 0.5, 20.0}) {
      const WindFrame frame(g, 0.3, periodic);
      SortedBed bed = spotted_bed(g, 3e-4);
      const double before = bed.coarse_volume();
      ActiveLayer layer(frame, bed);
      FrameField one, two, activity;
      frame.enter(bed.height, one);
      frame.enter(bed.height, two);
      std::vector<double> active = rough_bed(g, 0.3, 5);
      for (double& a : active) a = std::abs(1 + a);
      frame.enter(active, activity);
      SlopeFlux(frame, g.cell(), 1e-6).run(activity, 3, duration, one);
      SortedSlopeFlux(frame, g.cell(), 1e-6).run(activity, 3, duration, two, layer);
      for (int i = 0; i < frame.stations(); ++i)
        for (int row = 0; row < frame.rows(); ++row) ASSERT_NEAR(one.at(i)[row], two.at(i)[row], 1e-15);
      layer.settle();
      layer.leave();
      frame.leave(two, bed.height);
      EXPECT_NEAR(bed.coarse_volume(), before, 1e-16);
      for (std::size_t c = 0; c < bed.height.size(); ++c) {
        EXPECT_GE(bed.surface_fraction(c), -1e-12);
        EXPECT_LE(bed.surface_fraction(c), 1 + 1e-12);
      }
    }
}

TEST(SortedAvalancheTest, slopes_come_to_rest_as_those_of_one_size_do) {
  const GridGeometry g(0, 0, 0.002, 70, 50);
  for (const bool periodic : {true, false}) {
    const WindFrame frame(g, 0, periodic);
    const double repose = 0.65;
    SortedBed bed = spotted_bed(g, 3e-3);
    const double before = bed.coarse_volume();
    ActiveLayer layer(frame, bed);
    FrameField one, two;
    frame.enter(bed.height, one);
    frame.enter(bed.height, two);
    Avalanches(frame.stations(), frame.rows(), g.cell(), repose, periodic).run(one);
    EXPECT_GT(SortedAvalanches(frame, g.cell(), repose).run(two, layer), 0);
    double steepest = 0;
    double difference = 0;
    for (int i = 0; i < frame.stations(); ++i)
      for (int row = 0; row < frame.rows(); ++row) {
        difference = std::max(difference, std::abs(one.at(i)[row] - two.at(i)[row]));
        if (i > 0) steepest = std::max(steepest, std::abs(two.at(i)[row] - two.at(i - 1)[row]) / g.cell());
      }
    EXPECT_LT(steepest, 1.011 * repose);
    EXPECT_LT(difference, 1e-15) << periodic;
    layer.settle();
    layer.leave();
    frame.leave(two, bed.height);
    EXPECT_NEAR(bed.coarse_volume(), before, 1e-15);
  }
}

}  // namespace
}  // namespace aeolian
