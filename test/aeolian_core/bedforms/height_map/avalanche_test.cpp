#include "aeolian_core/bedforms/height_map/avalanche.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

const double tan_repose = std::tan(33 * M_PI / 180);
constexpr double cell = 0.002;

/// A bed of so many stations and rows with heights h(station, row).
struct Bed {
  int stations, rows;
  bool periodic;
  FrameField height{stations, rows};

  Bed(int stations_, int rows_, bool periodic_, const std::function<double(int, int)>& h)
      : stations(stations_), rows(rows_), periodic(periodic_) {
    for (int i = 0; i < stations; ++i)
      for (int row = 0; row < rows; ++row) height.at(i)[row] = h(i, row);
    fill_pads();
  }
  void fill_pads() {
    for (int i = 0; i < stations; ++i) height.fill_pads(i, periodic);
  }
  double slide() { return Avalanches(stations, rows, cell, tan_repose, periodic).run(height); }
  double at(int i, int row) const { return height.at(i)[row]; }
  double sum() const {
    double result = 0;
    for (int i = 0; i < stations; ++i)
      for (int row = 0; row < rows; ++row) result += at(i, row);
    return result;
  }
  /// The steepest slope to any of the eight neighbours.
  double steepest() const {
    double result = 0;
    for (int i = 0; i < stations; ++i)
      for (int row = 0; row < rows; ++row)
        for (const auto& [di, drow] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{-1, 1}}) {
          int to = i + di;
          int to_row = row + drow;
          if (periodic) {
            to = (to + stations) % stations;
            to_row %= rows;
          }
          if (to < 0 || to >= stations || to_row >= rows || (to == i && to_row == row)) continue;
          result = std::max(result, std::abs(at(i, row) - at(to, to_row)) / (cell * std::hypot(di, drow)));
        }
    return result;
  }
};

double cone(int i, int row, double slope) {
  return std::max(0.0, 0.05 * slope - slope * cell * std::hypot(i - 40, row - 40));
}

TEST(AvalancheTest, a_steep_cone_slides_to_repose_and_keeps_its_volume) {
  for (const double slope : {0.8, 1.5, 10.0}) {
    Bed bed(81, 81, false, [&](int i, int row) { return cone(i, row, slope); });
    const double before = bed.sum();
    EXPECT_GT(bed.slide(), 0);
    EXPECT_LE(bed.steepest(), tan_repose * 1.0101);
    EXPECT_GT(bed.steepest(), tan_repose * 0.99);
    EXPECT_NEAR(bed.sum(), before, 1e-12 * before);
  }
}

TEST(AvalancheTest, what_is_below_repose_is_left_bit_for_bit) {
  const Bed before(81, 81, false, [](int i, int row) { return cone(i, row, 0.9 * tan_repose); });
  Bed bed = before;
  EXPECT_EQ(bed.slide(), 0);
  for (int i = 0; i < 81; ++i)
    for (int row = 0; row < 81; ++row) ASSERT_EQ(bed.at(i, row), before.at(i, row));
}

TEST(AvalancheTest, a_slide_runs_on_beyond_what_was_steep) {
  Bed bed(96, 40, false, [](int i, int) { return i < 31 ? 0.05 : 0.0; });
  bed.slide();
  EXPECT_GT(bed.at(40, 16), 0);
  EXPECT_LE(bed.steepest(), tan_repose * 1.0101);
}

TEST(AvalancheTest, periodic_borders_are_joined_and_others_are_walls) {
  const auto spike = [](int i, int row) { return i == 0 && row == 0 ? 0.02 : 0.0; };
  Bed joined(40, 40, true, spike);
  joined.slide();
  EXPECT_GT(joined.at(39, 39), 0);
  EXPECT_LE(joined.steepest(), tan_repose * 1.0101);
  EXPECT_NEAR(joined.sum(), 0.02, 1e-15);
  Bed walled(40, 40, false, spike);
  walled.slide();
  EXPECT_EQ(walled.at(39, 39), 0);
  EXPECT_NEAR(walled.sum(), 0.02, 1e-15);
}

TEST(AvalancheTest, single_rows_stations_and_cells_slide_too) {
  for (const bool periodic : {false, true}) {
    Bed row(50, 1, periodic, [](int i, int) { return i == 25 ? 0.1 : 0.0; });
    row.slide();
    EXPECT_LE(row.steepest(), tan_repose * 1.0101);
    EXPECT_NEAR(row.sum(), 0.1, 1e-14);
    Bed station(1, 50, periodic, [](int, int at) { return at == 25 ? 0.1 : 0.0; });
    station.slide();
    EXPECT_LE(station.steepest(), tan_repose * 1.0101);
    EXPECT_NEAR(station.sum(), 0.1, 1e-14);
    Bed one(1, 1, periodic, [](int, int) { return 1.0; });
    EXPECT_EQ(one.slide(), 0);
  }
}

TEST(AvalancheTest, rock_holds_and_sand_on_it_slides_off) {
  // A block of rock with a layer of sand on top, and a column of unknown cells beside it.
  Bed bed(60, 60, false,
          [](int i, int row) { return i > 20 && i < 40 && row > 20 && row < 40 ? 0.022 : 0.0; });
  HardGround ground{FrameField(60, 60), FrameField(60, 60)};
  for (int i = 0; i < 60; ++i) {
    for (int row = 0; row < 60; ++row) {
      ground.floor.at(i)[row] = bed.at(i, row) > 0 ? 0.02 : HardGround::bottomless;
      ground.open.at(i)[row] = row == 42 ? 0 : 1;
    }
    ground.floor.fill_pads(i, false);
    ground.open.fill_pads(i, false);
  }
  const double before = bed.sum();
  ActivePatches active(60, 60);
  EXPECT_GT(Avalanches(60, 60, cell, tan_repose, false).run(bed.height, ground, active), 0);
  EXPECT_NEAR(bed.sum(), before, 1e-12);
  for (int i = 0; i < 60; ++i)
    for (int row = 0; row < 60; ++row) {
      ASSERT_GE(bed.at(i, row), ground.floor.at(i)[row] - 1e-15);
      if (row == 42) {
        ASSERT_EQ(bed.at(i, row), 0);
      }
    }
  EXPECT_LT(bed.at(21, 30), 0.022);
  EXPECT_GT(bed.at(20, 30), 0);
}

}  // namespace
}  // namespace aeolian
