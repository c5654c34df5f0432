#include "aeolian_core/twin/forecast_contest.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.005, 200, 100);

/// A wave along x, displaced, with independent noise in each cell.
HeightMap wave(double displacement, double noise = 0, std::uint64_t seed = 1) {
  HeightMap map(plot);
  HeightMap::Layer& z = map.add(layer::elevation, 0.0F);
  RandomStream random(seed, 3);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(0.002 * std::sin(2 * M_PI * (plot.x(plot.cell_at(i).x) - displacement) / 0.07) +
                              noise * random.normal());
  return map;
}

TEST(ForecastContest, TheNearerForecastHasTheAdvantageAndTheOtherTheSameDisadvantage) {
  const HeightMap measured = wave(0, 3e-4);
  EXPECT_GT(advantage(wave(0.002), wave(0.006), measured), 5);
  EXPECT_EQ(advantage(wave(0.002), wave(0.006), measured), -advantage(wave(0.006), wave(0.002), measured));
}

TEST(ForecastContest, OfTwoThatAreEquallyWrongNeitherWinsMoreOftenThanByChance) {
  int decided = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    if (std::abs(
            advantage(wave(0, 3e-4, 2 * seed), wave(0, 3e-4, 2 * seed + 1), wave(0, 3e-4, 1000 + seed))) > 2)
      ++decided;
  EXPECT_LE(decided, 6);  // two are to be expected beyond two standard errors
}

TEST(ForecastContest, WhatCannotBeToldIsZero) {
  const HeightMap measured = wave(0);
  EXPECT_EQ(advantage(wave(0.002), wave(0.002), measured), 0);
  HeightMap other(GridGeometry(0, 0, 0.005, 100, 100));
  other.add(layer::elevation, 0.0F);
  EXPECT_EQ(advantage(other, wave(0), measured), 0);
  HeightMap unknown(plot);
  unknown.add(layer::elevation, HeightMap::unknown);
  EXPECT_EQ(advantage(wave(0), wave(0.002), unknown), 0);
}

TEST(ForecastContest, UnknownCellsDoNotCount) {
  HeightMap holed = wave(0, 3e-4);
  HeightMap::Layer& z = holed.layer(layer::elevation);
  for (std::size_t i = 0; i < z.size(); i += 3) z[i] = HeightMap::unknown;
  EXPECT_GT(advantage(wave(0.002), wave(0.006), holed), 5);
}

}  // namespace
}  // namespace aeolian
