#include "aeolian_core/bedforms/theory/ripple_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void require_pairs(const char* what, const std::vector<double>& first, const std::vector<double>& second,
                   std::size_t least) {
  if (first.size() != second.size() || first.size() < least)
    throw Error(std::string(what) + ": " + std::to_string(first.size()) + " and " +
                std::to_string(second.size()) + " values, must be equally many and at least " +
                std::to_string(least));
}

}  // namespace

MovingShape fit_translation(const std::vector<double>& height, const std::vector<double>& flux) {
  require_pairs("heights and fluxes of a ripple", height, flux, 3);
  const double mean_height = mean(height);
  const double mean_flux = mean(flux);
  double hh = 0, hq = 0, qq = 0;
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double h = height[i] - mean_height;
    const double q = flux[i] - mean_flux;
    hh += h * h;
    hq += h * q;
    qq += q * q;
  }
  if (qq == 0) throw Error("fluxes over a ripple: all the same, nothing moves");
  const double slope = hq / qq;
  return {1 / slope, mean_height - slope * mean_flux, hh > 0 ? hq * hq / (hh * qq) : 0};
}

std::vector<double> flux_between(const std::vector<double>& before, const std::vector<double>& after,
                                 double spacing, double duration) {
  require_pairs("a profile before and after", before, after, 1);
  std::vector<double> flux(before.size());
  double upwind = 0;
  for (std::size_t i = 0; i < flux.size(); ++i) {
    const double downwind = upwind - (after[i] - before[i]) * spacing / duration;
    flux[i] = (upwind + downwind) / 2;
    upwind = downwind;
  }
  return flux;
}

double impact_ratio(double tan_slope, double impact_angle) {
  return std::max(0.0, 1 + tan_slope / std::tan(impact_angle));
}

double bed_diffusivity(double erosion_rate, double reptation_length, double impact_angle) {
  return -erosion_rate * reptation_length / std::tan(impact_angle);
}

double growth_rate(double erosion_rate, double reptation_length, double impact_angle, double wavenumber) {
  return erosion_rate / std::tan(impact_angle) * wavenumber * std::sin(wavenumber * reptation_length);
}

}  // namespace aeolian
