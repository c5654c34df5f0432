#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "ripple_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/bedforms/height_map/impact_angles.hpp"
#include "aeolian_core/bedforms/height_map/ripple_model.hpp"

namespace aeolian {
namespace {

TEST(RippleGrowthTest, single_modes_grow_and_move_as_linear_theory_says) {
  struct Case {
    double nu, mu;
  };
  for (const double waves_in_hop : {0.5, 0.83, 1.2})
    for (const Case c : {Case{0, 0.5}, Case{0, 1}, Case{0, 2}, Case{1, 0.4}, Case{2, 0}}) {
      const double cell = hop / 20;
      const int cells = static_cast<int>(std::lround(2 * M_PI / waves_in_hop * 20)) * 2;
      const double k = 4 * M_PI / (cells * cell);
      const double ka = k * hop;
      const GridGeometry g(0, 0, cell, cells, 1);
      std::vector<double> h(g.size());
      for (int x = 0; x < cells; ++x) h[g.index(x, 0)] = 1e-7 * std::cos(k * g.x(x));
      const double duration = 0.3 * unit_time;
      const std::complex<double> before = amplitude(g, h, k, 0);
      RippleModel(parameters(Border::periodic, c.mu, c.nu)).advance(g, h, wind(), duration);
      const std::complex<double> rate = std::log(amplitude(g, h, k, 0) / before) / duration;

      const double contrast = cot_alpha - c.nu;
      const double growth = erosion_rate * (contrast * k * ka / (1 + ka * ka) - c.mu * hop * k * k);
      const double speed = erosion_rate * contrast * (1 - 1 / (1 + ka * ka));
      EXPECT_NEAR(rate.real() / growth, 1, 0.01) << "ka " << ka << " nu " << c.nu << " mu " << c.mu;
      EXPECT_NEAR(-rate.imag() / k / speed, 1, 0.01) << "ka " << ka << " nu " << c.nu << " mu " << c.mu;
    }
}

TEST(RippleGrowthTest, with_impacts_of_several_angles_modes_grow_by_their_mean_cotangent) {
  const double cell = hop / 20;
  Forcing forcing = wind();
  forcing.impact_angle = 12 * degree;
  for (const double spread : {0.0, 2 * degree, 6 * degree}) {
    forcing.impact_angle_spread = spread;
    // Log-normal angles (Gauss-Hermite nodes): the cotangent of the mean angle alone would be 20 % low.
    const double contrast = 1 / ImpactAngles(forcing.impact_angle, spread).effective_tangent() - 1;
    const double ka = std::sqrt(std::sqrt(contrast / 0.4) - 1);
    const int cells = static_cast<int>(std::lround(2 * M_PI / ka * 20)) * 2;
    const double k = 4 * M_PI / (cells * cell);
    const GridGeometry g(0, 0, cell, cells, 1);
    std::vector<double> h(g.size());
    for (int x = 0; x < cells; ++x) h[g.index(x, 0)] = 1e-7 * std::cos(k * g.x(x));
    const double duration = 0.2 * unit_time;
    const std::complex<double> before = amplitude(g, h, k, 0);
    RippleModel(parameters(Border::periodic, 0.4, 1)).advance(g, h, forcing, duration);
    const std::complex<double> rate = std::log(amplitude(g, h, k, 0) / before) / duration;
    const double q = k * hop;
    const double growth = erosion_rate * (contrast * k * q / (1 + q * q) - 0.4 * hop * k * k);
    EXPECT_NEAR(rate.real() / growth, 1, 0.01) << spread;
  }
}

/// The rate at which a wave of (n, m) periods per side grows (real part) and turns, relative to linear
/// theory. Crests need not lie across the wind.
std::complex<double> oblique_mode(int n, int m, double wind_direction, double nu, double mu, double spread) {
  const int cells = 160;
  const GridGeometry g(0, 0, hop / 5, cells, cells);
  const double kx = 2 * M_PI * n / g.length_x();
  const double ky = 2 * M_PI * m / g.length_y();
  std::vector<double> h(g.size());
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) h[g.index(x, y)] = 1e-7 * std::cos(kx * g.x(x) + ky * g.y(y));
  const double duration = 0.2 * unit_time;
  const std::complex<double> before = amplitude(g, h, kx, ky);
  RippleParameters p = parameters(Border::periodic, mu, nu);
  p.lateral_spread = spread;
  RippleModel(p).advance(g, h, wind(wind_direction), duration);
  const std::complex<double> rate = std::log(amplitude(g, h, kx, ky) / before) / duration;

  const double along = kx * std::cos(wind_direction) + ky * std::sin(wind_direction);
  const double across = ky * std::cos(wind_direction) - kx * std::sin(wind_direction);
  const std::complex<double> ik(0, along);
  const std::complex<double> eroded = cot_alpha * ik;
  const std::complex<double> deposited = (eroded - nu * hop * along * along) / (1.0 + ik * hop) *
                                         std::exp(-0.5 * spread * hop * spread * hop * across * across);
  const std::complex<double> theory =
      erosion_rate * (deposited - eroded - mu * hop * (along * along + across * across));
  return {rate.real() / theory.real(), rate.imag() / theory.imag()};
}

TEST(RippleGrowthTest, a_mode_along_the_wind_grows_alike_whatever_the_wind_is) {
  // About 0, 17, 30 and 45 degrees to either axis; the waves are about as long as those that grow fastest.
  const CellIndex periods[] = {{7, 0}, {7, 2}, {6, 3}, {7, 4}, {5, 5}, {0, 7}, {-7, 0}, {-2, 7}, {4, -7}};
  for (const CellIndex n : periods)
    for (const double spread : {0.0, 0.25}) {
      const std::complex<double> default_slopes =
          oblique_mode(n.x, n.y, std::atan2(n.y, n.x), 1, 0.4, spread);
      EXPECT_NEAR(default_slopes.real(), 1, 0.01) << n.x << ' ' << n.y;
      EXPECT_NEAR(default_slopes.imag(), 1, 0.01) << n.x << ' ' << n.y;
      const std::complex<double> steep = oblique_mode(n.x, n.y, std::atan2(n.y, n.x), 0, 1, spread);
      EXPECT_NEAR(steep.real(), 1, 0.01) << n.x << ' ' << n.y;
      EXPECT_NEAR(steep.imag(), 1, 0.01) << n.x << ' ' << n.y;
    }
}

TEST(RippleGrowthTest, crests_lie_across_the_wind_whatever_the_wind_is) {
  // Waves turned to either side of the wind grow as theory says, so that none is favoured.
  for (const CellIndex w :
       {CellIndex{10, 0}, CellIndex{10, 3}, CellIndex{7, 4}, CellIndex{4, 7}, CellIndex{5, 5}})
    for (const CellIndex n : {CellIndex{7, 0}, CellIndex{7, 2}, CellIndex{6, 3}, CellIndex{6, 4},
                              CellIndex{5, 5}, CellIndex{3, 6}, CellIndex{2, 7}, CellIndex{6, -2}}) {
      const double direction = std::atan2(w.y, w.x);
      if (std::abs(std::atan2(n.y, n.x) - direction) > 0.6) continue;
      const std::complex<double> rate = oblique_mode(n.x, n.y, direction, 1, 0.4, 0.25);
      EXPECT_NEAR(rate.real(), 1, 0.02) << w.x << ' ' << w.y << ", " << n.x << ' ' << n.y;
      EXPECT_NEAR(rate.imag(), 1, 0.02) << w.x << ' ' << w.y << ", " << n.x << ' ' << n.y;
    }
}

}  // namespace
}  // namespace aeolian
