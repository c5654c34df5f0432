#include "aeolian_core/twin/line_spectra.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

LineCorrelation of_a_sine() {
  const GridGeometry grid(0, 0, 0.01, 200, 40);
  HeightMap::Layer z(grid.size());
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(std::sin(2 * M_PI * grid.cell_at(i).x / 20.0));
  const DirectionalLines lines(grid, z, Plane{}, 0);
  const LineSpectra spectra(lines);
  return LineCorrelation(spectra, spectra);
}

TEST(LineSpectraTest, a_sine_repeats_after_its_wavelength) {
  const Figure lag = of_a_sine().jackknifed(repeating_lag);
  EXPECT_NEAR(lag.value, 20, 0.02);
  EXPECT_LT(lag.sigma, 0.02);
}

TEST(LineSpectraTest, what_cannot_be_had_without_one_of_the_parts_is_not_known) {
  int calls = 0;
  const Figure figure = of_a_sine().jackknifed([&](const LineCorrelation::Curve&) -> std::optional<double> {
    if (++calls == 4) return std::nullopt;
    return 20.0;
  });
  EXPECT_TRUE(std::isnan(figure.value));
  EXPECT_TRUE(std::isnan(figure.sigma));
}

}  // namespace
}  // namespace aeolian
