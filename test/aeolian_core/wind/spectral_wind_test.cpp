#include "aeolian_core/wind/spectral_wind.hpp"

#include <algorithm>

#include "relief_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/inner_layer.hpp"

namespace aeolian {
namespace {

ReliefSettings settings(double roughness, bool periodic = false) {
  ReliefSettings s;
  s.roughness = roughness;
  s.shortest_wavelength = 0;
  s.periodic = periodic;
  return s;
}

double greatest(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return most;
}

// The release gate: without this no dune grows.
TEST(SpectralWind, StressPeaksUpwindOfTheCrest) {
  for (const double wavelength : {64.0, 16.0})
    for (const double kz0 : {1e-5, 1e-4, 1e-3}) {
      const double k = 2 * M_PI / wavelength;
      const int n = 256;
      const double cell = wavelength / n;
      const HeightMap map = ridge(2 * n, cell, [&](double x) { return 0.01 / k * std::cos(k * x); });
      const TerrainResponse r = SpectralWind(settings(kz0 / k, true)).solve(map, 0);
      const auto top = std::max_element(r.friction.begin(), r.friction.begin() + n) - r.friction.begin();
      const auto crest =
          std::max_element(map.layer(layer::elevation).begin(), map.layer(layer::elevation).begin() + n) -
          map.layer(layer::elevation).begin();
      const std::complex<double> stress = ReliefWave(UpwindProfile::log_law(kz0 / k), k, 1, 0).stress().along;
      const double lead = std::arg(stress) / (2 * M_PI);
      const double shift = static_cast<double>(((crest - top) % n + n) % n) / n;
      EXPECT_NEAR(shift, lead, 0.2 * lead) << kz0;
      if (kz0 == 1e-4) {
        EXPECT_NEAR(shift, 0.07, 0.014);
      }
    }
}

TEST(SpectralWind, ReversedWindMirrorsTheField) {
  const HeightMap map =
      world(97, 65, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 1.5, 12); });
  const SpectralWind wind(settings(1e-3));
  const TerrainResponse there = wind.solve(map, 0.4);
  const TerrainResponse back = wind.solve(map, 0.4 - M_PI);
  HeightMap::Layer turned(there.friction.rbegin(), there.friction.rend());
  EXPECT_LT(greatest(turned, back.friction), 2e-6);
  turned.assign(there.deflection.rbegin(), there.deflection.rend());
  EXPECT_LT(greatest(turned, back.deflection), 2e-6);
}

TEST(SpectralWind, DoesNotDependOnTheDirectionOfTheGrid) {
  const auto hill = [](double x, double y) { return gaussian(std::hypot(x, y), 1, 15); };
  const HeightMap map = world(129, 129, 1, hill);
  const SpectralWind wind(settings(1e-3));
  const auto crest = static_cast<std::size_t>(64 * 129 + 64);
  const double along = static_cast<double>(wind.solve(map, 0).friction[crest]);
  for (int eighth = 1; eighth < 8; ++eighth) {
    const TerrainResponse r = wind.solve(map, eighth * M_PI / 4);
    EXPECT_NEAR(r.friction[crest], along, 2e-3);
    EXPECT_NEAR(r.deflection[crest], 0, 2e-3);
  }
}

TEST(SpectralWind, FlatGroundChangesNothing) {
  for (const auto& [nx, ny] : {std::pair{33, 17}, {1, 50}, {50, 1}, {1, 1}}) {
    const TerrainResponse r =
        SpectralWind(settings(1e-4)).solve(world(nx, ny, 1, [](double, double) { return 3.0; }), 1);
    for (std::size_t i = 0; i < r.friction.size(); ++i) {
      EXPECT_NEAR(r.friction[i], 1, 1e-6);
      EXPECT_NEAR(r.deflection[i], 0, 1e-6);
      EXPECT_EQ(r.separated[i], 0);
    }
  }
}

TEST(SpectralWind, AnEdgeOrAHoleIsNoStep) {
  // A sloping plane has no relief, wherever it is cut off; a hole is as smooth as what surrounds it.
  HeightMap map = world(80, 60, 1, [](double x, double y) { return 0.05 * x - 0.03 * y + 200; });
  for (int y = 20; y < 35; ++y)
    for (int x = 30; x < 50; ++x)
      map.layer(layer::elevation)[map.geometry().index(x, y)] = HeightMap::unknown;
  const TerrainResponse r = SpectralWind(settings(1e-4)).solve(map, 0);
  for (std::size_t i = 0; i < r.friction.size(); ++i) {
    const bool known = std::isfinite(map.layer(layer::elevation)[i]);
    EXPECT_EQ(std::isfinite(r.friction[i]), known);
    if (known) {
      EXPECT_NEAR(r.friction[i], 1, 0.03);
    }
  }
}

TEST(SpectralWind, RipplesAreRoughness) {
  ReliefSettings s = settings(1e-5);
  s.shortest_wavelength = 0.5;
  const HeightMap map =
      world(400, 60, 0.01, [](double x, double) { return 0.004 * std::sin(2 * M_PI * x / 0.1); });
  const TerrainResponse r = SpectralWind(s).solve(map, 0);
  for (int x = 40; x < 360; ++x) EXPECT_NEAR(r.friction[map.geometry().index(x, 30)], 1, 0.01);
}

TEST(SpectralWind, TheLeeOfADuneIsSheltered) {
  const double rise = 3;
  const HeightMap map = world(400, 40, 0.5, [&](double x, double) { return dune(x + 40, rise, 40); });
  const TerrainResponse r = SpectralWind(settings(1e-4)).solve(map, 0);
  const auto at = [&](double x) { return map.geometry().index(map.geometry().find(x, 0)->x, 20); };
  EXPECT_EQ(r.separated[at(-42)], 0);
  EXPECT_EQ(r.separated[at(-37)], 1);  // on the slip face
  EXPECT_EQ(r.friction[at(-30)], 0);
  EXPECT_EQ(r.separated[at(0)], 0);
  // The bubble is 6 to 7.5 brinks long from a level brink; this brink's height is 3 m.
  double last = -40;
  for (double x = -40; x < 20; x += 0.5)
    if (r.separated[at(x)] > 0) last = x;
  EXPECT_GT((last + 40) / rise, 5);
  EXPECT_LT((last + 40) / rise, 8);
  // The other way there is a stoss of 32 degrees and a lee of 7.
  const TerrainResponse back = SpectralWind(settings(1e-4)).solve(map, M_PI);
  EXPECT_EQ(*std::max_element(back.separated.begin(), back.separated.end()), 0);
}

TEST(SpectralWind, StaysFiniteOnWhatNobodyWouldChoose) {
  const std::function<double(double, double)> worlds[] = {
      [](double x, double) { return x > 0 ? 50.0 : 0.0; },                                  // a cliff
      [](double x, double y) { return std::abs(x) < 0.6 && std::abs(y) < 0.6 ? 1e3 : 0; },  // a spike
      [](double x, double y) { return 5 * std::sin(x * 7.1) * std::cos(y * 5.3); },         // noise
      [](double x, double) { return -1e4 + 300 * x; }};
  for (const auto& height : worlds)
    for (const auto& [nx, ny] : {std::pair{40, 31}, {40, 1}, {1, 40}, {2, 2}})
      for (int eighth = 0; eighth < 8; ++eighth) {
        const TerrainResponse r =
            SpectralWind(settings(1e-3)).solve(world(nx, ny, 1, height), eighth * M_PI / 4);
        for (std::size_t i = 0; i < r.friction.size(); ++i) {
          ASSERT_TRUE(std::isfinite(r.friction[i]) && r.friction[i] >= 0);
          ASSERT_TRUE(std::isfinite(r.deflection[i]));
        }
      }
}

TEST(SpectralWind, RefusesWhatIsNotAllowed) {
  EXPECT_THROW(SpectralWind(settings(0)), Error);
  EXPECT_THROW(SpectralWind(settings(NAN)), Error);
  ReliefSettings s = settings(1e-4);
  s.bubble.steepest = 0.5;
  EXPECT_THROW(SpectralWind{s}, Error);
  s = settings(1e-4);
  s.shortest_wavelength = -1;
  const HeightMap map = world(4, 4, 1, [](double, double) { return 0; });
  EXPECT_THROW(SpectralWind(s).solve(map, 0), Error);
  EXPECT_THROW(SpectralWind(settings(1e-4)).solve(map, NAN), Error);
  HeightMap empty(GridGeometry(0, 0, 1, 4, 4));
  empty.add(layer::elevation);
  EXPECT_THROW(SpectralWind(settings(1e-4)).solve(empty, 0), Error);
}

}  // namespace
}  // namespace aeolian
