#include "aeolian_core/bedforms/avalanche.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

const double tan_repose = std::tan(33 * M_PI / 180);

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The steepest slope to any of the eight neighbours.
double steepest(const GridGeometry& g, const std::vector<double>& h, bool periodic) {
  double result = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      for (const CellIndex step : {CellIndex{1, 0}, CellIndex{0, 1}, CellIndex{1, 1}, CellIndex{-1, 1}}) {
        CellIndex to{x + step.x, y + step.y};
        if (periodic) to = {(to.x + g.nx()) % g.nx(), to.y % g.ny()};
        if (!g.contains(to) || to == CellIndex{x, y}) continue;
        const double distance = g.cell() * std::hypot(step.x, step.y);
        result = std::max(result, std::abs(h[g.index(x, y)] - h[g.index(to)]) / distance);
      }
  return result;
}

std::vector<double> cone(const GridGeometry& g, double slope) {
  std::vector<double> h(g.size());
  const double peak = 0.3 * slope * g.length_x();
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      h[g.index(x, y)] =
          std::max(0.0, peak - slope * std::hypot(g.x(x) - g.length_x() / 2, g.y(y) - g.length_y() / 2));
  return h;
}

TEST(AvalancheTest, a_steep_cone_slides_to_repose_and_keeps_its_volume) {
  const GridGeometry g(0, 0, 0.002, 81, 81);
  std::vector<double> h = cone(g, 1.5);
  const double before = sum(h);
  TileMask active(g, true);
  const double moved = avalanche(g, h, tan_repose, false, active);
  EXPECT_GT(moved, 0);
  EXPECT_LE(steepest(g, h, false), tan_repose * 1.0011);
  EXPECT_GT(steepest(g, h, false), tan_repose * 0.99);
  EXPECT_NEAR(sum(h), before, 1e-12 * before);
}

TEST(AvalancheTest, what_is_below_repose_is_left_bit_for_bit) {
  const GridGeometry g(0, 0, 0.002, 81, 81);
  std::vector<double> h = cone(g, 0.9 * tan_repose);
  const std::vector<double> before = h;
  TileMask active(g, true);
  EXPECT_EQ(avalanche(g, h, tan_repose, false, active), 0);
  EXPECT_EQ(h, before);
}

TEST(AvalancheTest, what_is_not_active_is_not_visited) {
  const GridGeometry g(0, 0, 0.002, 192, 64);
  std::vector<double> h(g.size(), 0.0);
  h[g.index(16, 16)] = 0.004;
  h[g.index(170, 16)] = 0.004;
  TileMask active(g);
  active.activate(16, 16);
  avalanche(g, h, tan_repose, false, active);
  EXPECT_LT(h[g.index(16, 16)], 0.004);
  EXPECT_EQ(h[g.index(170, 16)], 0.004);
  EXPECT_FALSE(active.tile(5, 0));
}

TEST(AvalancheTest, a_slide_runs_on_into_quiet_tiles) {
  const GridGeometry g(0, 0, 0.002, 96, 32);
  std::vector<double> h(g.size(), 0.0);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) h[g.index(x, y)] = 0.05;
  TileMask active(g);
  active.activate(31, 0);
  avalanche(g, h, tan_repose, false, active);
  EXPECT_GT(h[g.index(40, 16)], 0);
  EXPECT_TRUE(active.tile(1, 0));
  EXPECT_LE(steepest(g, h, false), tan_repose * 1.0011);
}

TEST(AvalancheTest, periodic_borders_are_joined_and_others_are_walls) {
  const GridGeometry g(0, 0, 0.002, 40, 40);
  std::vector<double> spike(g.size(), 0.0);
  spike[g.index(0, 0)] = 0.02;
  std::vector<double> joined = spike;
  TileMask active(g, true);
  avalanche(g, joined, tan_repose, true, active);
  EXPECT_GT(joined[g.index(39, 39)], 0);
  EXPECT_LE(steepest(g, joined, true), tan_repose * 1.0011);
  std::vector<double> walled = spike;
  active = TileMask(g, true);
  avalanche(g, walled, tan_repose, false, active);
  EXPECT_EQ(walled[g.index(39, 39)], 0);
  EXPECT_NEAR(sum(walled), 0.02, 1e-15);
}

TEST(AvalancheTest, single_rows_and_single_cells_slide_too) {
  for (const bool periodic : {false, true}) {
    const GridGeometry row(0, 0, 0.002, 50, 1);
    std::vector<double> h(row.size(), 0.0);
    h[25] = 0.1;
    TileMask active(row, true);
    avalanche(row, h, tan_repose, periodic, active);
    EXPECT_LE(steepest(row, h, false), tan_repose * 1.0011);
    EXPECT_NEAR(sum(h), 0.1, 1e-14);
    const GridGeometry one(0, 0, 0.002, 1, 1);
    std::vector<double> cell{1.0};
    active = TileMask(one, true);
    EXPECT_EQ(avalanche(one, cell, tan_repose, periodic, active), 0);
  }
}

}  // namespace
}  // namespace aeolian
