#include "aeolian_core/bedforms/lattice/lattice_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../../error_of.hpp"
#include "grain_model_fixture.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

using Fixture = GrainModelFixture;
constexpr double repose = 33 * M_PI / 180;

bool is_single_step(const LatticeBed& bed) {
  const auto height = [&](int x, int y) {
    return bed.heights()[static_cast<std::size_t>((y % bed.ny()) * bed.nx() + x % bed.nx())];
  };
  for (int y = 0; y < bed.ny(); ++y)
    for (int x = 0; x < bed.nx(); ++x)
      if (std::abs(height(x, y) - height(x + 1, y)) != 1 || std::abs(height(x, y) - height(x, y + 1)) != 1)
        return false;
  return true;
}

TEST(LatticeFromElevationTest, follows_any_surface_no_steeper_than_repose_within_two_layers) {
  const GridGeometry g(0, 0, 0.002, 30, 20);
  const double layer = 0.0005 * std::tan(repose);
  for (const double amplitude : {0.0, 0.0003, 0.004})
    for (const double offset : {0.0, 0.0001, -0.3}) {
      // Even along a column of cells: the surface between their centres is known.
      std::vector<double> elevation(g.size());
      for (std::size_t i = 0; i < elevation.size(); ++i)
        elevation[i] = offset + amplitude * std::sin(2 * M_PI * g.cell_at(i).x / 30);
      const LatticeBed bed = LatticeBed::from_elevation(g, elevation, 4, repose, 1);
      ASSERT_EQ(bed.nx(), 120);
      EXPECT_NEAR(bed.layer(), layer, 1e-15);
      EXPECT_TRUE(is_single_step(bed));
      EXPECT_LE(std::abs(bed.total()), 1);  // heights are above the mean; a grain is two layers of a column
      double worst = 0;
      for (int y = 0; y < bed.ny(); ++y)
        for (int x = 0; x < bed.nx(); ++x) {
          const double at = (x + 0.5) / 4 - 0.5;
          const double cell = std::floor(at);
          const auto h = [&](double i) { return amplitude * std::sin(2 * M_PI * i / 30); };
          const double surface = h(cell) * (1 - at + cell) + h(cell + 1) * (at - cell);
          worst = std::max(worst,
                           std::abs(bed.heights()[static_cast<std::size_t>(y * 120 + x)] - surface / layer));
        }
      EXPECT_LT(worst, 2.1) << amplitude << " " << offset;
    }
}

TEST(LatticeFromElevationTest, lays_cliffs_spikes_and_pits_at_repose) {
  const GridGeometry g(0, 0, 0.002, 31, 20);
  std::vector<double> elevation(g.size());
  for (std::size_t i = 0; i < elevation.size(); ++i) elevation[i] = g.cell_at(i).x < 15 ? 0.05 : 0;
  elevation[g.index(3, 3)] = 1;
  elevation[g.index(25, 10)] = -1;
  const LatticeBed bed = LatticeBed::from_elevation(g, elevation, 2, repose, 1);
  EXPECT_TRUE(is_single_step(bed));
  EXPECT_LE(std::abs(static_cast<double>(bed.total())), 1);
}

TEST(LatticeFromElevationTest, refuses_what_no_lattice_follows) {
  const GridGeometry g(0, 0, 0.002, 4, 4);
  std::vector<double> elevation(16);
  EXPECT_EQ(error_of([&] {
              LatticeBed::from_elevation(g, {1, 2}, 2, repose, 1);
            }),
            "lattice bed: 2 elevations for 16 cells");
  EXPECT_EQ(error_of([&] { LatticeBed::from_elevation(g, elevation, 0, repose, 1); }),
            "lattice bed: 0 columns per cell, must be 1 to 1000");
  elevation[5] = -160;
  EXPECT_EQ(error_of([&] { LatticeBed::from_elevation(g, elevation, 2, repose, 1); }),
            "lattice bed: an elevation is -150.000000 m above the mean, must be within 10.639245 m");
}

TEST(LatticeModelTest, the_map_changes_by_what_the_grains_do_and_keeps_its_sand) {
  for (const double direction : {0.0, 0.7, -M_PI / 2}) {
    HeightMap map = Fixture::rippled();
    // Far finer than a layer over a cell.
    map.layer(layer::elevation)[7] += 1e-5F;
    const HeightMap start = map;
    LatticeModel model({}, 1);
    for (int i = 0; i < 3; ++i) {
      const BedChange change = model.advance(map, Fixture::wind(direction), 20);
      EXPECT_LT(std::abs(change.volume.error()), 1e-12);
      EXPECT_NEAR(change.volume.moved, 20e-4 * 0.096 * 0.064, 0.05 * 20e-4 * 0.096 * 0.064);
      EXPECT_GT(change.active.count(), 0);
    }
    EXPECT_NEAR(Fixture::volume(map), Fixture::volume(start), Fixture::rounding(map));
    // Whole grains over the nine columns of a cell.
    const double step = 2 * 0.002 / 3 * std::tan(Fixture::wind().grain.angle_of_repose) / 9;
    for (std::size_t i = 0; i < map.geometry().size(); ++i) {
      const double grains =
          (static_cast<double>(map.layer(layer::elevation)[i]) - start.layer(layer::elevation)[i]) / step;
      EXPECT_NEAR(grains, std::round(grains), 0.05);
    }
  }
}

TEST(LatticeModelTest, goes_on_with_its_grains_unless_the_map_is_changed) {
  HeightMap kept = Fixture::rippled(), touched = kept;
  LatticeModel model({}, 1), other({}, 1);
  model.advance(kept, Fixture::wind(), 5);
  other.advance(touched, Fixture::wind(), 5);
  EXPECT_EQ(kept.layer(layer::elevation), touched.layer(layer::elevation));
  touched.layer(layer::elevation)[100] += 1e-4F;
  const HeightMap before = touched;
  model.advance(kept, Fixture::wind(), 5);
  other.advance(touched, Fixture::wind(), 5);
  EXPECT_NE(kept.layer(layer::elevation), touched.layer(layer::elevation));
  EXPECT_NEAR(Fixture::volume(touched), Fixture::volume(before), Fixture::rounding(touched));
}

TEST(LatticeModelTest, calm_leaves_the_map_bit_for_bit) {
  HeightMap map = Fixture::rippled();
  const HeightMap before = map;
  LatticeModel model({}, 1);
  Forcing calm = Fixture::wind();
  calm.ejection_rate = 0;
  EXPECT_EQ(model.advance(map, calm, 1000).active.count(), 0);
  EXPECT_EQ(model.advance(map, Fixture::wind(), 0).active.count(), 0);
  EXPECT_EQ(map.layer(layer::elevation), before.layer(layer::elevation));
}

TEST(LatticeModelTest, stands_extremes) {
  for (const double angle : {0.02, 1.4})
    for (const double reptation : {0.0, 5.0}) {
      HeightMap map = Fixture::rippled(15, 9);  // odd counts of cells
      const double before = Fixture::volume(map);
      Forcing forcing = Fixture::wind(2);
      forcing.impact_angle = angle;
      forcing.reptation_length = reptation;
      LatticeModel model({}, 2);
      model.advance(map, forcing, 2000);
      EXPECT_EQ(count_known(map.layer(layer::elevation)), map.geometry().size());
      EXPECT_NEAR(Fixture::volume(map), before, Fixture::rounding(map));
    }
}

TEST(LatticeModelTest, refuses_what_it_cannot_carry_forward) {
  LatticeModel model({}, 1);
  const auto error = [&](HeightMap map) { return error_of([&] { model.advance(map, Fixture::wind(), 1); }); };
  HeightMap holed = Fixture::rippled();
  holed.layer(layer::elevation)[3] = HeightMap::unknown;
  EXPECT_EQ(error(holed),
            "lattice model: 1 of 1536 cells of the layer elevation are unknown, all must be known");
  HeightMap grounded = Fixture::rippled();
  grounded.add(layer::ground, 0.0F);
  EXPECT_EQ(error(grounded), "lattice model: the map has a layer ground, must be sand all through");
  EXPECT_EQ(error_of([] { LatticeModel({-1}, 1); }),
            "lattice model: spacing is -1.000000 m, must be positive");
  HeightMap map = Fixture::rippled();
  LatticeModel fine({1e-6}, 1);
  EXPECT_EQ(error_of([&] { fine.advance(map, Fixture::wind(), 1); }),
            "lattice model: spacing is 0.000001 m, must be at least a thousandth of a cell of 0.002000 m");
  EXPECT_NE(error_of([&] { model.advance(map, Fixture::wind(), -1); }), "no error was thrown");
}

}  // namespace
}  // namespace aeolian
