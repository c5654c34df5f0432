#include "aeolian_core/measure/power_spectrum.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double step = 0.27e-3;

std::vector<double> wave(std::size_t count, double wavelength, double amplitude, double noise) {
  RandomStream random(8, 0);
  std::vector<double> z;
  for (std::size_t i = 0; i < count; ++i)
    z.push_back(amplitude * std::sin(2 * M_PI * static_cast<double>(i) * step / wavelength + 0.3) +
                noise * random.normal());
  return z;
}

TEST(PowerSpectrum, IntegralIsTheVariance) {
  PowerSpectrum spectrum(4000, step);
  const auto z = wave(4000, 0.0731, 0.002, 0.0002);
  const auto k = spectrum.wavenumber();
  const auto power = spectrum.density(z);
  ASSERT_EQ(k.size(), power.size());
  double integral = 0;
  for (const double p : power) integral += p * (k[1] - k[0]);
  double variance = 0;
  for (const double v : z) variance += v * v / 4000;
  EXPECT_NEAR(integral, variance, 0.01 * variance);
}

// White noise spreads its variance evenly up to the Nyquist wavenumber.
TEST(PowerSpectrum, LevelOfWhiteNoiseIsAnalytic) {
  PowerSpectrum spectrum(20000, step);
  const auto power = spectrum.density(wave(20000, 1, 0, 1e-4));
  double mean = 0;
  for (const double p : power) mean += p / static_cast<double>(power.size());
  EXPECT_NEAR(mean, 2 * step * 1e-8, 0.03 * 2 * step * 1e-8);
}

TEST(PowerSpectrum, PeakIsFoundBetweenTheBins) {
  PowerSpectrum spectrum(1000, step);
  for (const double wavelength : {0.02, 0.0317, 0.05, 0.0731}) {
    const auto peak = spectrum.peak(spectrum.density(wave(1000, wavelength, 0.002, 0.0001)), 6, INFINITY);
    ASSERT_TRUE(peak);
    EXPECT_NEAR(1 / *peak, wavelength, 0.004 * wavelength);
  }
  EXPECT_FALSE(spectrum.peak(spectrum.density(std::vector<double>(1000, 0.0)), 6, INFINITY));
}

}  // namespace
}  // namespace aeolian
