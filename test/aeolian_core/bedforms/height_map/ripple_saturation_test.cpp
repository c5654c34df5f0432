#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/bedforms/bedforms.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

Forcing blown(double friction_velocity, double diameter) {
  Grain grain;
  grain.diameter = diameter;
  return make_forcing(steady_saltation(friction_velocity, grain), 0, grain, MeanSplash{});
}

RippleParameters saturating(const Forcing& forcing, double wavelength) {
  RippleParameters result;
  result.border = Border::periodic;
  result.relief_scale = 100;
  result.wavelength_law = std::make_shared<ConstantWavelength>(wavelength / forcing.grain.diameter);
  return result;
}

FastestGrowth growth_of(const Forcing& forcing) {
  const RippleParameters p;
  return fastest_growth(forcing, p.hop_shortening, p.slope_effect);
}

std::vector<double> noise(const GridGeometry& g, double deviation) {
  RandomStream random(1, 0);
  std::vector<double> h(g.size());
  for (double& z : h) z = deviation * random.normal();
  return h;
}

/// Mean over the rows.
double mean_wavelength_of(const GridGeometry& g, const std::vector<double>& h) {
  double wavelength = 0;
  for (int y = 0; y < g.ny(); ++y) {
    const auto row = h.begin() + static_cast<std::ptrdiff_t>(g.index(0, y));
    wavelength += mean_wavelength({row, row + g.nx()}, g.cell()) / g.ny();
  }
  return wavelength;
}

TEST(RippleSaturationTest, fastest_growth_is_the_maximum_of_the_growth_rate) {
  const Forcing forcing = blown(0.45, 0.0004);
  const FastestGrowth growth = growth_of(forcing);
  const double a = forcing.reptation_length;
  const double contrast = 1 / std::tan(forcing.impact_angle) - 1;
  const auto rate = [&](double k) {
    return forcing.erosion_rate() * (contrast * k * k * a / (1 + k * k * a * a) - 0.4 * a * k * k);
  };
  const double k = 2 * M_PI / growth.wavelength;
  EXPECT_NEAR(rate(k) / growth.rate, 1, 1e-12);
  EXPECT_LT(rate(1.01 * k), growth.rate);
  EXPECT_LT(rate(0.99 * k), growth.rate);
  EXPECT_EQ(fastest_growth(forcing, 1, 5).rate, 0);
}

TEST(RippleSaturationTest, the_fastest_wave_grows_as_without) {
  const Forcing forcing = blown(0.45, 0.0004);
  const FastestGrowth growth = growth_of(forcing);
  const int cells = static_cast<int>(std::lround(growth.wavelength / 0.002)) * 10;
  const GridGeometry g(0, 0, growth.wavelength * 10 / cells, cells, 4);
  for (const double ratio : {1.0, 1.6, 2.0, 2.5, 4.0}) {
    std::vector<double> h(g.size());
    for (int y = 0; y < g.ny(); ++y)
      for (int x = 0; x < cells; ++x)
        h[g.index(x, y)] = 1e-7 * std::cos(2 * M_PI * g.x(x) / growth.wavelength);
    const auto amplitude = [&] {
      std::complex<double> total = 0;
      for (int x = 0; x < cells; ++x)
        total += h[g.index(x, 0)] * std::polar(1.0, -2 * M_PI * g.x(x) / growth.wavelength);
      return std::abs(total);
    };
    const double before = amplitude();
    const double duration = 1 / growth.rate;
    RippleModel(saturating(forcing, ratio * growth.wavelength)).advance(g, h, forcing, duration);
    EXPECT_NEAR(std::log(amplitude() / before), 1, 0.01) << ratio;
  }
}

TEST(RippleSaturationTest, ripples_stop_growing_at_the_wavelength_of_the_law) {
  // bench/ripple_model_rows.cpp has more winds, grains and laws, wider and longer.
  const Forcing forcing = blown(0.45, 0.0004);
  const FastestGrowth growth = growth_of(forcing);
  const double law = 1.7 * growth.wavelength;
  const GridGeometry g(0, 0, 0.0025, static_cast<int>(20 * law / 0.0025), 8);
  std::vector<double> h = noise(g, 2e-4);
  RippleModel model(saturating(forcing, law));
  double before = 0;
  for (const double z : h) before += z;
  model.advance(g, h, forcing, 50 / growth.rate);
  EXPECT_NEAR(mean_wavelength_of(g, h) / law, 1, 0.15);
  model.advance(g, h, forcing, 70 / growth.rate);
  EXPECT_NEAR(mean_wavelength_of(g, h) / law, 1, 0.15);
  double after = 0;
  for (const double z : h) after += z;
  EXPECT_NEAR(after, before, 1e-10);
}

TEST(RippleSaturationTest, a_stiff_bias_makes_ripples_as_flat_as_nature) {
  const Forcing forcing = blown(0.45, 0.0004);
  const FastestGrowth growth = growth_of(forcing);
  const GridGeometry g(0, 0, 0.0025, 200, 8);
  RippleParameters p = saturating(forcing, 1.7 * growth.wavelength);
  p.doubling_slope = 4 * degree;
  std::vector<double> h = noise(g, 2e-4);
  RippleModel(p).advance(g, h, forcing, 60 / growth.rate);
  const HeightMap::Layer elevation(h.begin(), h.end());
  double steepest = 0;
  for (int x = 0; x + 1 < g.nx(); ++x)
    steepest = std::max(steepest, std::abs(h[g.index(x + 1, 4)] - h[g.index(x, 4)]) / g.cell());
  EXPECT_LT(std::atan(steepest), 15 * degree);
  const auto [low, high] = std::minmax_element(h.begin(), h.end());
  EXPECT_GT(1.7 * growth.wavelength / (*high - *low), 12);
  EXPECT_LT(1.7 * growth.wavelength / (*high - *low), 25);
}

TEST(RippleSaturationTest, refuses_slopes_that_are_none) {
  for (const double slope : {0.0, -0.1, 2.0, std::nan("")}) {
    RippleParameters p;
    p.doubling_slope = slope;
    EXPECT_THROW(RippleModel{p}, Error);
  }
  RippleParameters p;
  p.wavelength_law = std::make_shared<LinearWavelength>(250);
  Forcing forcing = blown(0.45, 0.0004);
  forcing.friction_velocity = 0;
  const GridGeometry g(0, 0, 0.002, 20, 20);
  std::vector<double> h(g.size(), 0.0);
  EXPECT_THROW(RippleModel(p).advance(g, h, forcing, 10), Error);
}

}  // namespace
}  // namespace aeolian
