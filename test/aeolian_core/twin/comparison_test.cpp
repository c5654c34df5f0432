#include "aeolian_core/twin/comparison.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry grid(0, 0, 0.002, 300, 150);
constexpr double wavelength = 0.08;
constexpr double amplitude = 0.003;

HeightMap::Layer sinusoid(double shift, double direction = 0, double offset = 0) {
  HeightMap::Layer z(grid.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const CellIndex c = grid.cell_at(i);
    const double along = grid.x(c.x) * std::cos(direction) + grid.y(c.y) * std::sin(direction) - shift;
    z[i] = static_cast<float>(offset + amplitude * std::sin(2 * M_PI * along / wavelength));
  }
  return z;
}

TEST(Comparison, EqualSurfacesGiveExactZeros) {
  const HeightMap::Layer z = sinusoid(0, 0.3);
  const Comparison c = compare(grid, z, z, z, 0.3);
  EXPECT_EQ(c.cells, grid.size());
  for (const double value : {c.bias, c.rmse, c.nmad, c.volume_change_measured, c.volume_change_predicted,
                             c.displacement_measured, c.displacement_predicted, c.rmse_persistence,
                             c.rmse_translation, c.skill_persistence, c.skill_translation})
    EXPECT_EQ(value, 0);
  EXPECT_EQ(c.wavelength_measured, c.wavelength_predicted);
  EXPECT_EQ(c.height_measured, c.height_predicted);
}

TEST(Comparison, OfASurfaceRaisedByAConstant) {
  const double rise = 0.0005;
  const Comparison c = compare(grid, sinusoid(0, 0, rise), sinusoid(0), sinusoid(0), 0);
  EXPECT_NEAR(c.bias, rise, 1e-8);
  EXPECT_NEAR(c.rmse, rise, 1e-8);
  EXPECT_NEAR(c.nmad, 0, 1e-8);
  EXPECT_NEAR(c.volume_change_predicted, rise * grid.length_x() * grid.length_y(), 1e-8);
  EXPECT_EQ(c.volume_change_measured, 0);
  EXPECT_EQ(c.skill_persistence, -INFINITY);  // nothing changed, and that baseline is perfect
}

TEST(Comparison, RmseOfMovedRipplesIsTheChord) {
  // sin(x - s) - sin(x) has an amplitude of 2 sin(s/2).
  const double shift = 0.01;
  const Comparison c = compare(grid, sinusoid(0), sinusoid(shift), sinusoid(0), 0);
  EXPECT_NEAR(c.rmse, amplitude * 2 * std::sin(M_PI * shift / wavelength) / std::sqrt(2), 0.01 * c.rmse);
}

TEST(Comparison, PersistenceHasNoSkillAndAPerfectForecastHasAll) {
  const HeightMap::Layer start = sinusoid(0);
  const HeightMap::Layer measured = sinusoid(0.015);
  EXPECT_EQ(compare(grid, start, measured, start, 0).skill_persistence, 0);
  const Comparison perfect = compare(grid, measured, measured, start, 0);
  EXPECT_EQ(perfect.skill_persistence, 1);
  EXPECT_EQ(perfect.skill_translation, 1);
  EXPECT_EQ(perfect.rmse, 0);
}

class ComparisonAlong : public testing::TestWithParam<double> {};

TEST_P(ComparisonAlong, MovedSinusoidIsTranslation) {
  const double direction = GetParam();
  const double shift = 0.02;
  const Comparison c =
      compare(grid, sinusoid(0.01, direction), sinusoid(shift, direction), sinusoid(0, direction), direction);
  EXPECT_NEAR(c.displacement_measured, shift, 0.01 * shift);
  EXPECT_NEAR(c.displacement_predicted, 0.01, 0.01 * shift);
  EXPECT_NEAR(c.wavelength_measured, wavelength, 0.01 * wavelength);
  EXPECT_NEAR(c.height_measured, 2 * amplitude, 0.03 * amplitude);
  EXPECT_LT(c.rmse_translation, 0.01 * amplitude);
  EXPECT_LT(c.rmse_translation, c.rmse);
  EXPECT_LT(c.rmse, c.rmse_persistence);
  EXPECT_LT(c.skill_translation, 0);
}

INSTANTIATE_TEST_SUITE_P(Directions, ComparisonAlong, testing::Values(0.0, M_PI / 2, M_PI, -0.6));

TEST(Comparison, UnknownCellsOfAnySurfaceAreLeftOut) {
  HeightMap::Layer predicted = sinusoid(0.01);
  HeightMap::Layer measured = sinusoid(0.02);
  HeightMap::Layer start = sinusoid(0);
  const Comparison whole = compare(grid, predicted, measured, start, 0);
  predicted[5] = measured[6] = start[7] = HeightMap::unknown;
  for (int y = 0; y < 20; ++y) measured[grid.index(40, y)] = HeightMap::unknown;
  start[8] = 1e6F;  // must not count: this cell of the forecast is unknown
  predicted[8] = HeightMap::unknown;
  const Comparison c = compare(grid, predicted, measured, start, 0);
  EXPECT_EQ(c.cells, grid.size() - 24);
  EXPECT_NEAR(c.rmse, whole.rmse, 0.01 * whole.rmse);
  EXPECT_NEAR(c.rmse_persistence, whole.rmse_persistence, 0.01 * whole.rmse_persistence);
  EXPECT_NEAR(c.wavelength_measured, whole.wavelength_measured, 0.01 * wavelength);
  EXPECT_NEAR(c.displacement_measured, whole.displacement_measured, 0.01 * wavelength);
}

TEST(Comparison, TranslationIsNeverWorseThanPersistence) {
  RandomStream random(7, 0);
  HeightMap::Layer start(grid.size());
  HeightMap::Layer measured(grid.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    start[i] = static_cast<float>(1e-3 * random.normal());
    measured[i] = static_cast<float>(1e-3 * random.normal());
  }
  const Comparison c = compare(grid, start, measured, start, 0.5);
  EXPECT_LE(c.rmse_translation, c.rmse_persistence);
  EXPECT_TRUE(std::isnan(c.wavelength_measured));  // noise has no ripples
}

TEST(Comparison, AFlatBedHasNoRipplesButErrors) {
  const Comparison c = compare(grid, HeightMap::Layer(grid.size(), 0.001F), HeightMap::Layer(grid.size(), 0),
                               HeightMap::Layer(grid.size(), 0), 0);
  EXPECT_NEAR(c.rmse, 0.001, 1e-9);
  EXPECT_TRUE(std::isnan(c.wavelength_measured));
}

TEST(Comparison, RefusesWhatCannotBeCompared) {
  const HeightMap::Layer z = sinusoid(0);
  EXPECT_THROW(compare(grid, HeightMap::Layer(10, 0), z, z, 0), Error);
  EXPECT_THROW(compare(grid, z, HeightMap::Layer(10, 0), z, 0), Error);
  EXPECT_THROW(compare(grid, z, z, HeightMap::Layer(10, 0), 0), Error);
  EXPECT_THROW(compare(grid, z, z, z, NAN), Error);
  HeightMap::Layer left(grid.size(), HeightMap::unknown);
  HeightMap::Layer right(grid.size(), HeightMap::unknown);
  for (std::size_t i = 0; i < grid.size(); ++i) (i % 2 ? left : right)[i] = 0;
  EXPECT_THROW(compare(grid, left, right, left, 0), Error);
}

}  // namespace
}  // namespace aeolian
