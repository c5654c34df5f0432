#include "aeolian_core/twin/surface_comparison.hpp"

#include <cmath>
#include <functional>

#include "noise_fields.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/difference.hpp"

namespace aeolian {
namespace {

using Shape = std::function<double(double phase)>;  // period 1

double sine(double phase) { return std::sin(2 * M_PI * phase); }

/// A ripple as the wind makes it: a long, slightly convex stoss side and a lee side of a quarter of the
/// length.
double ripple(double phase) {
  const double p = phase - std::floor(phase);
  constexpr double crest = 0.75;
  return p < crest ? -1 + 2 * std::pow(p / crest, 1.3) : 1 - 2 * (p - crest) / (1 - crest);
}

HeightMap waves(const GridGeometry& grid, const Shape& shape, double wavelength, double amplitude,
                double shift, double direction = 0) {
  HeightMap::Layer z(grid.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const CellIndex at = grid.cell_at(i);
    const double along = std::cos(direction) * grid.x(at.x) + std::sin(direction) * grid.y(at.y) - shift;
    // The mean over the cell, as a sensor has it: a sharp crest between two centres is not lost.
    double sum = 0;
    for (int k = 0; k < 8; ++k)
      sum += shape((along + grid.cell() * ((k + 0.5) / 8 - 0.5) * std::max(std::cos(direction), 0.5)) /
                   wavelength);
    z[i] = static_cast<float>(amplitude * sum / 8);
  }
  return map_of(grid, z);
}

HeightMap with_noise(HeightMap map, double sigma, std::uint64_t seed) {
  HeightMap::Layer& z = map.layer(layer::elevation);
  const HeightMap::Layer noise = white_noise(map.geometry(), sigma, seed);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += noise[i];
  return map;
}

const GridGeometry plot(0, 0, 0.002, 400, 200);

TEST(SurfaceComparisonTest, a_surface_against_itself_gives_exact_zeros) {
  HeightMap a = with_noise(waves(plot, ripple, 0.08, 0.003, 0), 0.0003, 1);
  a.layer(layer::elevation)[777] = HeightMap::unknown;
  const SurfaceComparison c = compare_surfaces(a, a, nullptr, {});
  for (const Figure& figure : {c.difference.bias, c.difference.rmse, c.difference.nmad, c.difference.le90,
                               c.volume.gain, c.volume.loss, c.volume.net, c.offset}) {
    EXPECT_EQ(figure.value, 0);
    EXPECT_EQ(figure.sigma, 0);
  }
  EXPECT_EQ(c.volume.significant_cells, 0u);
  ASSERT_FALSE(c.crests.displacement.empty());
  for (const double d : c.crests.displacement) EXPECT_EQ(d, 0);
  ASSERT_FALSE(c.coherence.squared.empty());
  for (const double squared : c.coherence.squared) EXPECT_EQ(squared, 1);
  EXPECT_EQ(c.a.wavelength.value, c.b.wavelength.value);
  const SurfaceComparison scored = compare_surfaces(a, a, &a, {});
  EXPECT_EQ(scored.skill->persistence.value, 0);
  EXPECT_EQ(scored.skill->migration_a.value, 0);
}

TEST(SurfaceComparisonTest, patterns_have_the_figures_of_ripple_statistics) {
  const double direction = 0.3;
  const HeightMap a = with_noise(waves(plot, ripple, 0.08, 0.003, 0, direction), 0.0003, 1);
  const HeightMap b = with_noise(waves(plot, ripple, 0.06, 0.002, 0, direction + 0.1), 0.0003, 2);
  ComparisonSettings settings;
  settings.direction = direction;
  const SurfaceComparison c = compare_surfaces(a, b, nullptr, settings);
  for (const auto& [map, figures] : {std::pair{&a, &c.a}, std::pair{&b, &c.b}}) {
    const RippleStatistics expected = ripple_statistics(plot, map->layer(layer::elevation), direction);
    EXPECT_NEAR(figures->wavelength.value, expected.wavelength, 1e-3 * expected.wavelength);
    EXPECT_NEAR(figures->height.value, expected.height, 0.01 * expected.height);
    EXPECT_LT(figures->wavelength.sigma, 0.02 * expected.wavelength);
    EXPECT_GT(figures->wavelength.sigma, 0);
    EXPECT_NEAR(figures->scales.dominant.value, expected.wavelength, 0.02 * expected.wavelength);
  }
  EXPECT_NEAR(c.a.crest_normal.value, direction, 0.005);
  EXPECT_NEAR(c.b.crest_normal.value, direction + 0.1, 0.005);
}

/// Bar: migration to 1 %, of the shift or, for those of less than a tenth of a wavelength, of a cell.
void expect_migration(const Shape& shape, double wavelength, double direction) {
  const HeightMap start = with_noise(waves(plot, shape, wavelength, 0.003, 0, direction), 0.0002, 11);
  ComparisonSettings settings;
  settings.direction = direction;
  for (const double cells : {0.3, 0.5, 1.25, 4.0, 7.7}) {
    const double shift = cells * plot.cell();
    if (shift > 0.4 * wavelength) continue;
    const HeightMap moved = with_noise(waves(plot, shape, wavelength, 0.003, shift, direction), 0.0002, 12);
    const SurfaceComparison c = compare_surfaces(moved, start, nullptr, settings);
    const double allowed = std::max(0.01 * shift, 0.01 * plot.cell());
    EXPECT_NEAR(c.offset.value, shift, allowed) << wavelength << " m, " << cells << " cells";
    EXPECT_LT(c.offset.sigma, 0.01 * wavelength);
    EXPECT_NEAR(c.crests.median, shift, std::max(0.02 * shift, 0.03 * plot.cell())) << cells;
  }
}

TEST(SurfaceComparisonTest, migration_of_sinusoids_is_right_to_one_percent_also_within_a_cell) {
  expect_migration(sine, 0.08, 0);
  expect_migration(sine, 0.047, 0);
  expect_migration(sine, 0.08, 0.4);
}

TEST(SurfaceComparisonTest, migration_of_asymmetric_ripples_is_right_to_one_percent) {
  expect_migration(ripple, 0.08, 0);
  expect_migration(ripple, 0.047, 0);
}

TEST(SurfaceComparisonTest, crests_that_move_apart_are_seen_place_by_place) {
  const GridGeometry grid(0, 0, 0.002, 600, 300);
  const HeightMap b = waves(grid, sine, 0.06, 0.003, 0);
  HeightMap a = waves(grid, sine, 0.06, 0.003, 0.004);  // the northern half twice as far
  const HeightMap farther = waves(grid, sine, 0.06, 0.003, 0.008);
  for (int y = 150; y < 300; ++y)
    for (int x = 0; x < 600; ++x)
      a.layer(layer::elevation)[grid.index(x, y)] = farther.layer(layer::elevation)[grid.index(x, y)];
  const SurfaceComparison c = compare_surfaces(a, b, nullptr, {});
  const HeightMap::Layer& d = c.map.layer(layer::displacement);
  EXPECT_NEAR(static_cast<double>(d[grid.index(300, 40)]), 0.004, 4e-5);
  EXPECT_NEAR(static_cast<double>(d[grid.index(300, 260)]), 0.008, 8e-5);
  EXPECT_NEAR(c.offset.value, 0.006, 4e-4);
}

TEST(SurfaceComparisonTest, skill_compares_with_persistence_and_with_translation) {
  const HeightMap start = waves(plot, sine, 0.08, 0.003, 0);
  const HeightMap truth = waves(plot, sine, 0.08, 0.003, 0.01);
  const HeightMap forecast = waves(plot, sine, 0.08, 0.003, 0.008);
  const SurfaceComparison c = compare_surfaces(forecast, truth, &start, {});
  // The rms of sin(x) - sin(x - p) is proportional to sin(p / 2).
  const double expected = 1 - std::pow(std::sin(M_PI * 0.002 / 0.08) / std::sin(M_PI * 0.01 / 0.08), 2);
  EXPECT_NEAR(c.skill->persistence.value, expected, 1e-3);
  EXPECT_LT(c.skill->persistence.sigma, 0.01);
  EXPECT_LT(c.skill->translation.value, 0);  // that baseline is all but perfect
  EXPECT_NEAR(c.skill->migration_b.value, 0.01, 1e-4);
  EXPECT_NEAR(c.skill->migration_a.value, 0.008, 1e-4);
}

TEST(SurfaceComparisonTest, a_single_profile_is_compared_too) {
  const GridGeometry line(0, 0, 0.002, 600, 1);
  const HeightMap b = with_noise(waves(line, ripple, 0.08, 0.003, 0), 0.0002, 3);
  const HeightMap a = with_noise(waves(line, ripple, 0.08, 0.003, 0.01), 0.0002, 4);
  const SurfaceComparison c = compare_surfaces(a, b, nullptr, {});
  EXPECT_NEAR(c.b.wavelength.value, 0.08, 0.0004);
  EXPECT_NEAR(c.offset.value, 0.01, 0.0001);
  EXPECT_GT(c.offset.sigma, 0);
  EXPECT_TRUE(std::isnan(c.a.crest_normal.value));
}

TEST(SurfaceComparisonTest, levels_say_what_they_rest_on) {
  HeightMap a = map_of(plot, white_noise(plot, 0.001, 5));
  const HeightMap b = map_of(plot, white_noise(plot, 0.001, 6));
  ComparisonSettings settings;
  EXPECT_NE(compare_surfaces(a, b, nullptr, settings).detection.find("NMAD of all"), std::string::npos);
  HeightMap::Layer stable(plot.size(), 0);
  std::fill(stable.begin(), stable.begin() + 20000, 1.0F);
  for (std::size_t i = 20000; i < plot.size(); ++i) a.layer(layer::elevation)[i] += 0.05F;
  settings.stable = &stable;
  const SurfaceComparison c = compare_surfaces(a, b, nullptr, settings);
  EXPECT_NE(c.detection.find("stable ground"), std::string::npos);
  EXPECT_NEAR(static_cast<double>(c.map.layer(layer::lod95)[0]), 1.96 * 0.001 * std::sqrt(2.0), 5e-5);
  EXPECT_NEAR(c.volume.gain.value, 0.05 * 60000 * 4e-6, 1e-5);
  settings.sigma_a = 0.002;
  settings.sigma_b = 0.001;
  EXPECT_NEAR(static_cast<double>(compare_surfaces(a, b, nullptr, settings).map.layer(layer::lod95)[0]),
              1.96 * std::sqrt(5e-6), 1e-6);
}

TEST(SurfaceComparisonTest, says_what_cannot_be_compared) {
  const HeightMap a = map_of(plot, white_noise(plot, 0.001, 1));
  const HeightMap other = map_of(GridGeometry(0, 0, 0.002, 10, 10), HeightMap::Layer(100, 0));
  EXPECT_THROW(compare_surfaces(a, other, nullptr, {}), Error);
  const HeightMap unknown = map_of(plot, HeightMap::Layer(plot.size(), HeightMap::unknown));
  EXPECT_THROW(compare_surfaces(a, unknown, nullptr, {}), Error);
  const HeightMap cell = map_of(GridGeometry(0, 0, 1, 1, 1), HeightMap::Layer(1, 0));
  EXPECT_THROW(compare_surfaces(cell, cell, nullptr, {}), Error);
  EXPECT_THROW(compare_surfaces(HeightMap(plot), a, nullptr, {}), Error);
  ComparisonSettings settings;
  settings.direction = NAN;
  EXPECT_THROW(compare_surfaces(a, a, nullptr, settings), Error);
}

TEST(SurfaceComparisonTest, a_level_bed_has_no_ripples_but_differences) {
  const HeightMap a = map_of(plot, white_noise(plot, 0.001, 1));
  const HeightMap b = map_of(plot, white_noise(plot, 0.001, 2));
  const SurfaceComparison c = compare_surfaces(a, b, nullptr, {});
  EXPECT_TRUE(std::isnan(c.a.wavelength.value));
  EXPECT_TRUE(std::isnan(c.a.height.value));
  EXPECT_TRUE(std::isnan(c.offset.value));
  EXPECT_NEAR(c.difference.rmse.value, 0.001 * std::sqrt(2.0), 3e-5);
}

}  // namespace
}  // namespace aeolian
