#pragma once

#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

constexpr double hop = 0.01;
constexpr double erosion_rate = 1e-4;

inline Forcing wind(double direction = 0) {
  Forcing forcing;
  forcing.direction = direction;
  forcing.impact_angle = 10 * degree;
  const double side = forcing.grain.effective_diameter();
  forcing.ejection_rate = erosion_rate / (side * side * side);
  forcing.reptation_length = hop;
  return forcing;
}

const double cot_alpha = 1 / std::tan(10 * degree);
constexpr double unit_time = hop / erosion_rate;  ///< [s] in which a reptation length of depth is set moving

inline RippleParameters parameters(Border border, double slope_effect, double hop_shortening = 0) {
  RippleParameters result;
  result.border = border;
  result.slope_effect = slope_effect;
  result.hop_shortening = hop_shortening;
  result.relief_scale = 100;
  return result;
}

inline double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

inline std::vector<double> noise(const GridGeometry& g, double deviation, std::uint64_t seed = 1) {
  RandomStream random(seed, 0);
  std::vector<double> h(g.size());
  for (double& value : h) value = deviation * random.normal();
  return h;
}

inline double deviation(const std::vector<double>& h) {
  const double mean = sum(h) / static_cast<double>(h.size());
  double square = 0;
  for (const double v : h) square += (v - mean) * (v - mean);
  return std::sqrt(square / static_cast<double>(h.size()));
}

/// The complex amplitude of one plane wave.
inline std::complex<double> amplitude(const GridGeometry& g, const std::vector<double>& h, double kx,
                                      double ky) {
  std::complex<double> total = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      total += h[g.index(x, y)] * std::polar(1.0, -(kx * g.x(x) + ky * g.y(y)));
  return total * 2.0 / static_cast<double>(h.size());
}

}  // namespace aeolian
