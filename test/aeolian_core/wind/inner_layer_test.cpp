#include "aeolian_core/wind/inner_layer.hpp"

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/bessel_k.hpp"
#include "aeolian_core/wind/wave_table.hpp"

namespace aeolian {
namespace {

using Complex = std::complex<double>;

TEST(BesselK, Tabulated) {
  // Abramowitz & Stegun, table 9.8, and Kelvin functions ker, kei (table 9.12): K0(x e^(i pi/4)) = ker + i
  // kei.
  EXPECT_NEAR(bessel_k(0.1).k0.real(), 2.4270690247, 1e-9);
  EXPECT_NEAR(bessel_k(1.0).k0.real(), 0.4210244382, 1e-9);
  EXPECT_NEAR(bessel_k(1.0).k1.real(), 0.6019072302, 1e-9);
  EXPECT_NEAR(bessel_k(5.0).k0.real(), 0.0036910983, 1e-9);
  EXPECT_NEAR(bessel_k(5.0).k1.real(), 0.0040446134, 1e-9);
  const Complex kelvin = bessel_k(std::polar(1.0, M_PI / 4)).k0;
  EXPECT_NEAR(kelvin.real(), 0.2867062087, 1e-9);
  EXPECT_NEAR(kelvin.imag(), -0.4949946365, 1e-9);
}

TEST(BesselK, SeriesAndContinuedFractionMeet) {
  for (const double angle : {-M_PI / 4, 0.0, 0.3, M_PI / 4}) {
    const BesselK below = bessel_k(std::polar(2 - 1e-9, angle));
    const BesselK above = bessel_k(std::polar(2 + 1e-9, angle));
    EXPECT_LT(std::abs(below.k0 - above.k0), 1e-9);
    EXPECT_LT(std::abs(below.k1 - above.k1), 1e-9);
  }
  EXPECT_EQ(bessel_k(2000.0).k0, Complex(0));
}

TEST(InnerLayer, DepthsSolveTheirEquations) {
  // Askervein: 11.8 m (Jackson & Hunt), with L = 220 m.
  EXPECT_NEAR(inner_depth(220, 0.03), 11.8, 0.05);
  for (const double ratio : {10.0, 1e3, 1e6}) {
    const double l = inner_depth(ratio, 1);
    EXPECT_NEAR(l * std::log(l), 0.32 * ratio, 1e-9 * ratio);
    const double h = middle_height(ratio, 1);
    EXPECT_NEAR(h * std::sqrt(std::log(h)), ratio, 1e-9 * ratio);
  }
}

TEST(ReliefWave, StressCoefficientsOfTheSpec) {
  const double table[][3] = {{1e-6, 2.97, 0.88}, {1e-5, 3.12, 1.15}, {1e-4, 3.31, 1.60}, {1e-3, 3.50, 2.36}};
  for (const auto& row : table)
    for (const double k : {0.01, 1.0, 100.0}) {
      const UpwindProfile upwind = UpwindProfile::log_law(row[0] / k);
      const Complex stress = ReliefWave(upwind, k, 1, 0).stress().along;
      EXPECT_NEAR(stress.real() / k, row[1], 0.01);
      EXPECT_NEAR(stress.imag() / k, row[2], 0.01);
      // Against the wave the answer is the mirror image.
      EXPECT_LT(std::abs(ReliefWave(upwind, k, -1, 0).stress().along - std::conj(stress)), 1e-12 * k);
    }
}

TEST(ReliefWave, StressIsTheShearOfItsVelocity) {
  const double z0 = 1e-5;
  const UpwindProfile upwind = UpwindProfile::log_law(z0);
  for (const double cosine : {1.0, 0.6, -0.8}) {
    const ReliefWave wave(upwind, 1, cosine, std::sqrt(1 - cosine * cosine));
    const double z = z0 * 1.0005;
    const WaveResponse u = wave.velocity(z);
    const WaveResponse stress = wave.stress();
    // Mixing length: 2 kappa z du/dz along, kappa z dv/dz across, in units of u*.
    EXPECT_LT(std::abs(0.8 * z * u.along / (z - z0) - stress.along), 2e-3 * std::abs(stress.along));
    EXPECT_LE(std::abs(0.4 * z * u.across / (z - z0) - stress.across), 2e-3 * std::abs(stress.across));
  }
}

TEST(ReliefWave, IsPotentialFlowWithoutShearAndFarAloft) {
  const UpwindProfile uniform = UpwindProfile::uniform();
  const WaveResponse u = ReliefWave(uniform, 2, 0.6, 0.8).velocity(0.3);
  EXPECT_NEAR(u.along.real(), 2 * 0.36 * std::exp(-0.6), 1e-12);
  EXPECT_NEAR(u.across.real(), 2 * 0.48 * std::exp(-0.6), 1e-12);
}

TEST(WaveTable, IsWhatItTabulates) {
  const UpwindProfile upwind = UpwindProfile::log_law(1e-4);
  const WaveTable table(upwind, 0.01, 100, [](const ReliefWave& w) { return w.stress(); });
  for (const double k : {0.01, 0.137, 3.3, 99.0})
    for (double angle = -3.1; angle < 3.14; angle += 0.37) {
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      const WaveResponse exact = ReliefWave(upwind, k, c, s).stress();
      const WaveTable::Parts parts = table(static_cast<float>(k * c), static_cast<float>(k * s));
      const double tolerance = 5e-3 * 3.5 * k;
      EXPECT_NEAR(parts.along_real, exact.along.real(), tolerance) << k << " " << angle;
      EXPECT_NEAR(parts.along_imaginary, exact.along.imag(), tolerance) << k << " " << angle;
      EXPECT_NEAR(parts.across_real, exact.across.real(), tolerance) << k << " " << angle;
      EXPECT_NEAR(parts.across_imaginary, exact.across.imag(), tolerance) << k << " " << angle;
    }
}

}  // namespace
}  // namespace aeolian
