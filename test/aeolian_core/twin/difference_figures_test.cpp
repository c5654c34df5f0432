#include "aeolian_core/twin/difference_figures.hpp"

#include <cmath>
#include <vector>

#include "noise_fields.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/volume_change.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.01, 400, 250);

TEST(DifferenceFiguresTest, figures_of_normal_noise_are_those_of_its_law) {
  HeightMap::Layer d = white_noise(plot, 0.002, 1);
  for (float& v : d) v += 0.001F;
  const DifferenceFigures f = difference_figures(plot, d);
  EXPECT_EQ(f.cells, plot.size());
  EXPECT_NEAR(f.bias.value, 0.001, 3 * 0.002 / std::sqrt(1e5));
  EXPECT_NEAR(f.rmse.value, std::sqrt(5e-6), 3e-5);
  EXPECT_NEAR(f.nmad.value, 0.002, 3e-5);
  const double n = std::sqrt(static_cast<double>(plot.size()));
  EXPECT_NEAR(f.bias.sigma, 0.002 / n, 0.1 * 0.002 / n);
  EXPECT_NEAR(f.nmad.sigma, 1.1664 * 0.002 / n,
              0.15 * 0.002 / n);  // efficiency 36.74 % of a median deviation
}

TEST(DifferenceFiguresTest, le90_of_centred_normal_noise_is_1_6449_sigma) {
  const DifferenceFigures f = difference_figures(plot, white_noise(plot, 0.002, 2));
  EXPECT_NEAR(f.le90.value, 1.644854 * 0.002, 3 * f.le90.sigma);
  EXPECT_LT(f.le90.sigma, 0.01 * f.le90.value);
}

TEST(DifferenceFiguresTest, a_median_of_nothing_but_zeros_has_no_sign) {
  HeightMap::Layer d(plot.size(), 0.0F);
  for (std::size_t i = 0; i < 1000; ++i) d[97 * i] = -0.3F;
  const DifferenceFigures f = difference_figures(plot, d);
  EXPECT_EQ(f.nmad.value, 0);
  EXPECT_FALSE(std::signbit(f.nmad.value));
  EXPECT_FALSE(std::signbit(f.le90.value));
}

TEST(DifferenceFiguresTest, figures_of_heavy_tails_follow_the_laplace_law) {
  RandomStream random(3, 0);
  HeightMap::Layer d(plot.size());
  const double scale = 0.001;  // density exp(-|d| / scale) / 2 scale
  for (float& v : d) v = static_cast<float>(scale * random.exponential() * (random.uniform() < 0.5 ? -1 : 1));
  const DifferenceFigures f = difference_figures(plot, d);
  EXPECT_NEAR(f.nmad.value, 1.4826 * std::log(2.0) * scale, 3 * f.nmad.sigma);
  EXPECT_NEAR(f.le90.value, std::log(10.0) * scale, 3 * f.le90.sigma);
  EXPECT_NEAR(f.rmse.value, std::sqrt(2.0) * scale, 3 * f.rmse.sigma);
  EXPECT_LT(f.nmad.sigma, 0.01 * f.nmad.value);
  // Var(d^2) = 20 scale^4.
  EXPECT_NEAR(f.rmse.sigma, std::sqrt(20.0 / 1e5) * scale / (2 * std::sqrt(2.0)), 0.15 * f.rmse.sigma);
}

/// Of simulated maps, the share whose figures lie within 1.96 standard errors of the truth.
template <class FiguresOf>
std::vector<double> coverage(double reach, const std::vector<double>& truth, FiguresOf&& figures_of) {
  constexpr int maps = 300;
  const GridGeometry grid(0, 0, 1, 128, 128);
  std::vector<double> covered(truth.size());
  for (int map = 0; map < maps; ++map) {
    const auto seed = static_cast<std::uint64_t>(100 + map);
    const std::vector<Figure> figures =
        figures_of(grid, reach > 0 ? correlated_noise(grid, 1, reach, seed) : white_noise(grid, 1, seed));
    for (std::size_t i = 0; i < truth.size(); ++i)
      covered[i] += std::abs(figures[i].value - truth[i]) <= 1.96 * figures[i].sigma ? 1.0 / maps : 0;
  }
  return covered;
}

TEST(DifferenceFiguresTest, standard_errors_hold_for_independent_and_for_correlated_noise) {
  const auto figures = [](const GridGeometry& g, const HeightMap::Layer& d) {
    const DifferenceFigures f = difference_figures(g, d);
    return std::vector<Figure>{f.bias, f.rmse, f.nmad, f.le90};
  };
  for (const double reach : {0.0, 2.0})
    for (const double share : coverage(reach, {0, 1, 1, 1.644854}, figures)) {
      EXPECT_GE(share, 0.91) << reach;
      EXPECT_LE(share, 0.99) << reach;
    }
}

TEST(DifferenceFiguresTest, area_of_correlation_is_that_of_the_law) {
  const GridGeometry grid(0, 0, 1, 600, 600);
  EXPECT_NEAR(correlation_area(grid, white_noise(grid, 1, 1)), 1, 0.35);
  const double reach = 3;
  const double expected = std::pow(1 / std::tanh(1 / (2 * reach)), 2);
  HeightMap::Layer noise = correlated_noise(grid, 1, reach, 2);
  EXPECT_NEAR(correlation_area(grid, noise), expected, 0.25 * expected);
  RandomStream random(9, 0);
  for (float& v : noise)
    if (random.uniform() < 0.5) v = HeightMap::unknown;  // half of the cells show the same
  EXPECT_NEAR(correlation_area(grid, noise), expected, 0.3 * expected);
}

TEST(VolumeChangeTest, net_volume_is_covered_with_correlated_noise) {
  // The second as if cells erred on their own: for the correlated maps several times too small.
  const auto net = [](const GridGeometry& g, const HeightMap::Layer& d) {
    HeightMap map(g);
    map.add(layer::difference, d);
    map.add(layer::lod95, 1.96F);
    HeightMap::Layer quiet = d;
    for (float& v : quiet)
      if (std::abs(v) > 1.96F) v = HeightMap::unknown;
    return std::vector<Figure>{volume_change(map, correlation_area(g, quiet)).net, volume_change(map, 1).net};
  };
  EXPECT_GE(coverage(0, {0, 0}, net)[0], 0.92);
  const std::vector<double> correlated = coverage(2, {0, 0}, net);
  EXPECT_GE(correlated[0], 0.90);
  EXPECT_LT(correlated[1], 0.5);
}

TEST(VolumeChangeTest, gain_and_loss_are_counted_beyond_the_level) {
  const GridGeometry grid(0, 0, 0.1, 10, 10);
  HeightMap map(grid);
  HeightMap::Layer& d = map.add(layer::difference, 0.01F);
  map.add(layer::lod95, 0.02F);
  d[0] = d[1] = 0.05F;
  d[2] = -0.03F;
  d[3] = HeightMap::unknown;
  const VolumeChange volume = volume_change(map, 1, 0.001);
  EXPECT_EQ(volume.known_cells, 99u);
  EXPECT_EQ(volume.significant_cells, 3u);
  EXPECT_NEAR(volume.gain.value, 0.1 * 0.01, 1e-8);
  EXPECT_NEAR(volume.loss.value, 0.03 * 0.01, 1e-8);
  EXPECT_NEAR(volume.net.value, 0.01 * (0.1 - 0.03 + 0.96), 1e-7);
  EXPECT_NEAR(volume.gain.sigma, 0.01 * std::hypot(std::sqrt(2.0) * 0.02 / 1.96, 0.002), 1e-8);
}

TEST(LevelOfDetectionTest, covers_ninety_five_percent_of_noise) {
  const HeightMap::Layer a = white_noise(plot, 0.001, 21);
  const HeightMap::Layer b = white_noise(plot, 0.0007, 22);
  const HeightMap::Layer level =
      level_of_detection(HeightMap::Layer(plot.size(), 1e-6F), HeightMap::Layer(plot.size(), 0.49e-6F));
  std::size_t within = 0;
  for (std::size_t i = 0; i < a.size(); ++i) within += std::abs(a[i] - b[i]) <= level[i] ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(within) / static_cast<double>(a.size()), 0.95, 0.01);
}

}  // namespace
}  // namespace aeolian
