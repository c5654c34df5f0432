#include "aeolian_core/bedforms/height_map/impact_noise.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double hop = 0.01;
constexpr double depth = 2e-4;
constexpr double grain_volume = 5.6e-11;

/// A flat bed after the noise of some steps.
FrameField noisy(const WindFrame& frame, double cell, double share, std::uint64_t steps, std::uint64_t seed) {
  FrameField bed(frame.stations(), frame.rows());
  ImpactSweep sweep(frame, 0.2, hop, 1);
  sweep.run(bed, bed, depth);
  const ImpactNoise noise(frame, cell, {hop, 0.25 * hop, 1}, grain_volume, share, seed);
  const ActivePatches active(frame.stations(), frame.rows());
  for (std::uint64_t step = 0; step < steps; ++step) noise.run(sweep, depth, step, nullptr, active, bed);
  return bed;
}

double product(const FrameField& bed, int stations, int lag) {
  double sum = 0;
  for (int i = 0; i < stations; ++i)
    for (int row = 0; row < bed.rows(); ++row) sum += bed.at(i)[row] * bed.at((i + lag) % stations)[row];
  return sum / (stations * bed.rows());
}

TEST(ImpactNoiseTest, variance_of_a_flat_bed_is_that_of_single_grains) {
  // In a step a cell loses and gains depth * area / grain_volume grains, but for those that stay in it.
  for (const double cell : {0.001, 0.002, 0.005})
    for (const double share : {1.0, 0.1})
      for (const double direction : {0.0, 0.6}) {
        const WindFrame frame(GridGeometry(0, 0, cell, 240, 240), direction, true);
        const FrameField bed = noisy(frame, cell, share, 10, 3);
        // The share that stays, for a wind along the grid: along it, hops are exponential, across it normal.
        const double wide = cell / (0.25 * hop);
        const double stays_along = 1 + std::expm1(-cell / hop) * hop / cell;
        const double stays_across =
            std::erf(wide / std::sqrt(2)) + std::sqrt(2 / M_PI) / wide * std::expm1(-wide * wide / 2);
        const double grains = 10 * 2 * depth * cell * cell / grain_volume * (1 - stays_along * stays_across);
        const double height = grain_volume / (cell * cell);
        EXPECT_NEAR(product(bed, 240, 0) / (grains * height * height), 1, 0.03)
            << cell << ' ' << share << ' ' << direction;
      }
}

TEST(ImpactNoiseTest, what_one_cell_loses_lies_within_hops_downwind) {
  const double cell = 0.002;
  const WindFrame frame(GridGeometry(0, 0, cell, 400, 400), 0, true);
  const FrameField bed = noisy(frame, cell, 1, 20, 5);
  // Grains per step that go from a cell to the row of cells n downwind; the spread across, 1.25 cells, shares
  // them among rows.
  const double variance = 20 * depth * grain_volume / (cell * cell);
  double total = 0;
  for (int lag = 1; lag < 30; ++lag)
    for (int across = -8; across <= 8; ++across) {
      double sum = 0;
      for (int i = 0; i < 400; ++i)
        for (int row = 8; row < 392; ++row) sum += bed.at(i)[row] * bed.at((i + lag) % 400)[row + across];
      total += sum / (400 * 384);
    }
  const double leave = -std::expm1(-cell / hop) * hop / cell;
  EXPECT_NEAR(total / (-variance * leave), 1, 0.1);
}

TEST(ImpactNoiseTest, sand_is_conserved) {
  for (const bool periodic : {true, false}) {
    const WindFrame frame(GridGeometry(0, 0, 0.002, 90, 70), 0.5, periodic);
    const FrameField bed = noisy(frame, 0.002, 0.3, 50, 1);
    double sum = 0;
    for (int i = 0; i < frame.stations(); ++i)
      for (int row = 0; row < frame.rows(); ++row) sum += bed.at(i)[row];
    EXPECT_NEAR(sum, 0, 1e-15);
  }
}

Forcing blown() {
  Grain grain;
  grain.diameter = 0.0004;
  return make_forcing(steady_saltation(0.45, grain), 0.3, grain, MeanSplash{});
}

std::vector<double> ripples(const GridGeometry& g) {
  std::vector<double> h(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) h[g.index(x, y)] = 0.001 * std::sin(2 * M_PI * g.x(x) / 0.06);
  return h;
}

TEST(ImpactNoiseTest, the_mean_of_many_noisy_runs_is_the_run_without) {
  // On finer cells grains are rougher, slopes steeper, and ripples grow 1 to 2 % less for it.
  const GridGeometry g(0, 0, 0.004, 90, 40);
  RippleParameters p;
  p.border = Border::periodic;
  p.relief_scale = 100;
  std::vector<double> mean_field = ripples(g);
  RippleModel(p).advance(g, mean_field, blown(), 120);
  constexpr int members = 60;
  std::vector<double> sum(g.size(), 0.0);
  std::vector<double> square(g.size(), 0.0);
  p.stochastic_share = 1;
  for (int member = 0; member < members; ++member) {
    p.seed = static_cast<std::uint64_t>(100 + member);
    std::vector<double> h = ripples(g);
    RippleModel(p).advance(g, h, blown(), 120);
    for (std::size_t i = 0; i < h.size(); ++i) {
      sum[i] += h[i] - mean_field[i];
      square[i] += (h[i] - mean_field[i]) * (h[i] - mean_field[i]);
    }
  }
  // The square of the mean difference over that of its standard error, averaged over the cells, is 1; its own
  // error is sqrt(2 / independent cells), where noise is alike over about 20 cells.
  double error = 0;
  double spread = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double mean = sum[i] / members;
    error += mean * mean * members;
    spread += square[i] / members - mean * mean;
  }
  EXPECT_GT(std::sqrt(spread / static_cast<double>(g.size())), 5e-5);
  EXPECT_NEAR(error / spread, 1, 4 * std::sqrt(2.0 * 20 / static_cast<double>(g.size())));
}

TEST(ImpactNoiseTest, seeds_differ_and_threads_do_not) {
  const GridGeometry g(0, 0, 0.002, 150, 140);
  const auto bed = [&](std::uint64_t seed, std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    RippleParameters p;
    p.stochastic_share = 0.1;
    p.seed = seed;
    std::vector<double> h = ripples(g);
    RippleModel(p).advance(g, h, blown(), 100);
    return h;
  };
  EXPECT_EQ(bed(1, 1), bed(1, 3));
  EXPECT_NE(bed(1, 1), bed(2, 1));
}

TEST(ImpactNoiseTest, noise_goes_on_from_run_to_run) {
  const GridGeometry g(0, 0, 0.002, 60, 60);
  RippleParameters p;
  p.stochastic_share = 1;
  RippleModel model(p);
  std::vector<double> first = ripples(g);
  std::vector<double> second = ripples(g);
  model.advance(g, first, blown(), 10);
  model.advance(g, second, blown(), 10);
  EXPECT_NE(first, second);
}

TEST(ImpactNoiseTest, hard_ground_stays) {
  const GridGeometry g(0, 0, 0.002, 150, 100);
  HeightMap map(g);
  HeightMap::Layer& h = map.add(layer::elevation, 0.01F);
  HeightMap::Layer& ground = map.add(layer::ground, HeightMap::unknown);
  HeightMap::Layer& elevation = map.layer(layer::elevation);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 60; x < 110; ++x) ground[g.index(x, y)] = x < 80 ? 0.00998F : 0.01F;
  for (int y = 20; y < 40; ++y)
    for (int x = 120; x < 130; ++x) elevation[g.index(x, y)] = HeightMap::unknown;
  RippleParameters p;
  p.stochastic_share = 1;
  const BedChange change = RippleModel(p).advance(map, blown(), 100);
  EXPECT_NEAR(change.volume.error(), 0, 1e-12);
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (std::isfinite(ground[i])) {
      ASSERT_GE(h[i], ground[i] - 1e-8F);
    }
  }
}

TEST(ImpactNoiseTest, refuses_shares_that_are_none) {
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    RippleParameters p;
    p.stochastic_share = share;
    EXPECT_THROW(RippleModel{p}, Error);
  }
}

}  // namespace
}  // namespace aeolian
