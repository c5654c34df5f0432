#include "aeolian_core/grains/impacts/bed_packing.hpp"

#include "../../../error_of.hpp"
#include "small_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using Packing = BedRecipe::Packing;

void expect_rest(const BedState& state, double calm) {
  EXPECT_LT(state.kinetic_energy, calm);
  EXPECT_LT(state.overlap_energy, 0.05);  // of m g d: no bed blows up with that
  EXPECT_GT(state.coordination, 2.5);
}

TEST(BedPacking, LooseBedTouchesAndIsNoCrystal) {
  const BedRecipe recipe = small_recipe();
  const auto bed = make_bed(recipe, soft_discs(), 1);
  EXPECT_EQ(bed.state.grains, 160);
  expect_rest(bed.state, recipe.calm);
  // Between the square lattice (pi / 4) and the hexagonal one (pi / sqrt(12)).
  EXPECT_GT(bed.state.packing_fraction, 0.75);
  EXPECT_LT(bed.state.packing_fraction, 0.90);
}

TEST(BedPacking, DenseBedIsHexagonalWithTwoSteps) {
  BedRecipe recipe = small_recipe(Packing::dense);
  recipe.length = 0.6101;  // 30 columns; the plateau begins at the sixth
  recipe.grains = 5 * 30 + 16;
  const auto bed = make_bed(recipe, soft_discs(), 1);
  expect_rest(bed.state, recipe.calm);
  EXPECT_NEAR(bed.state.packing_fraction, M_PI / std::sqrt(12.), 0.05);  // less where the walls leave gaps
  EXPECT_NEAR(bed.state.roughness, 2 * recipe.radius / recipe.length, 1e-9);
  int brinks = 0;
  int anti_brinks = 0;
  for (const int grain : bed.grains.numbers()) {
    brinks += bed.surface.step(grain) == Origin::brink;
    anti_brinks += bed.surface.step(grain) == Origin::anti_brink;
  }
  EXPECT_EQ(brinks, 2);
  EXPECT_EQ(anti_brinks, 2);
}

TEST(BedPacking, PouredSpheresPackAtRandom) {
  BedRecipe recipe;
  recipe.packing = Packing::poured;
  recipe.grains = 500;
  recipe.length = 0.16;
  recipe.width = 0.12;
  recipe.size_spread = 0.1;
  recipe.calm = 1e-4;
  const auto bed = make_bed(recipe, soft_spheres(), 1);
  expect_rest(bed.state, recipe.calm);
  // Random loose to random close packing: 0.55 to 0.64 (Onoda & Liniger 1990; Scott & Kilgour 1969).
  EXPECT_GT(bed.state.packing_fraction, 0.53);
  EXPECT_LT(bed.state.packing_fraction, 0.66);
  EXPECT_GT(bed.state.coordination, 4);
  EXPECT_LT(bed.state.coordination, 6.5);
  EXPECT_GT(bed.state.roughness, 0);
  double least = 1;
  double largest = 0;
  for (const int grain : bed.grains.numbers()) {
    least = std::min(least, bed.grains.radius(grain) / recipe.radius);
    largest = std::max(largest, bed.grains.radius(grain) / recipe.radius);
  }
  EXPECT_GT(least, 0.78);
  EXPECT_LT(largest, 1.24);
  EXPECT_GT(largest - least, 0.25);
}

TEST(BedPacking, StruckOffBedIsLevel) {
  BedRecipe recipe = small_recipe(Packing::struck);
  const auto struck = make_bed(recipe, soft_discs(), 3);
  expect_rest(struck.state, recipe.calm);
  EXPECT_LT(struck.state.grains, recipe.grains);
  EXPECT_LT(struck.surface.top() - struck.surface.mean_height(), 2.5 * recipe.radius);
}

TEST(BedPacking, SeedDecidesAll) {
  const auto places = [](std::uint64_t seed) {
    const auto bed = make_bed(small_recipe(), soft_discs(), seed);
    std::vector<double> result;
    for (const int grain : bed.grains.numbers()) result.push_back(bed.grains.position(grain).x());
    return result;
  };
  EXPECT_EQ(places(1), places(1));
  EXPECT_NE(places(1), places(2));
}

TEST(BedPacking, RefusesWhatCannotBe) {
  const auto message = [](const BedRecipe& recipe) {
    return error_of([&] { make_bed(recipe, soft_discs(), 1); });
  };
  BedRecipe recipe = small_recipe();
  recipe.radius = 0;
  EXPECT_EQ(message(recipe), "bed: radius is 0, must be positive");
  recipe = small_recipe();
  recipe.grains = 0;
  EXPECT_EQ(message(recipe), "bed: grains is 0, must be 1 to 10000000");
  recipe = small_recipe();
  recipe.size_spread = 0.6;
  EXPECT_EQ(message(recipe), "bed: size_spread is 0.6, must be 0 to 0.5");
  recipe = small_recipe();
  recipe.length = 0.05;
  EXPECT_EQ(message(recipe), "bed: length is 0.05, must be at least 4 diameters");
  BedRecipe spheres = small_recipe();
  spheres.width = 0.2;
  EXPECT_THROW(make_bed(spheres, soft_spheres(), 1), Error);
}

}  // namespace
}  // namespace aeolian
