#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian::synthetic {

constexpr double grain = 0.272e-3;  ///< of the Kelso Dunes [m]

using Curve = std::function<double(double)>;

/// Triangles of one wavelength, troughs at whole wavelengths, with given angles left and right of the crest.
inline Curve triangles(double wavelength, double left, double right) {
  return [=](double x) {
    const double s = x - wavelength * std::floor(x / wavelength);
    return std::min(s * std::tan(left), (wavelength - s) * std::tan(right));
  };
}

/// A smooth ripple train, the steeper flank on the right, troughs at whole wavelengths, height `height`.
inline Curve leaning(double wavelength, double height) {
  double trough = -0.5 * M_PI;
  for (int i = 0; i < 50; ++i) trough = -0.5 * M_PI + 0.5 * std::sin(trough);
  return [=](double x) {
    const double phase = 2 * M_PI * x / wavelength + trough;
    return 0.5 * height * (1 + std::sin(phase - 0.5 * std::sin(phase)));
  };
}

/// Heights of a curve at even stations from 0, seen without error.
inline ShadowProfile profile_of(const Curve& curve, double length, double step) {
  ShadowProfile profile;
  for (int i = 0; i * step <= length; ++i) {
    profile.x.push_back(i * step);
    profile.z.push_back(curve(i * step));
  }
  profile.sigma_z.assign(profile.x.size(), 0);
  return profile;
}

/// The same lying on a bed that falls by `dip` along x: each point moves with the bed.
inline ShadowProfile dipping(const Curve& curve, double length, double step, double dip) {
  ShadowProfile profile = profile_of(curve, length, step);
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    const double x = profile.x[i];
    const double z = profile.z[i];
    profile.x[i] = x * std::cos(dip) + z * std::sin(dip);
    profile.z[i] = z * std::cos(dip) - x * std::sin(dip);
  }
  return profile;
}

/// Adds noise correlated over two stations, as grains make it.
inline void add_noise(ShadowProfile& profile, double sigma, std::uint64_t seed) {
  RandomStream random(seed, 0);
  double before = random.normal();
  for (std::size_t i = 0; i < profile.z.size(); ++i) {
    const double now = random.normal();
    profile.z[i] += sigma * (before + now) / std::sqrt(2.0);
    profile.sigma_z[i] = sigma;
    before = now;
  }
}

}  // namespace aeolian::synthetic
