#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// A figure in another unit (its value times `factor`) with the digits that its standard error allows:
/// "72.7 +- 0.4".
inline std::string stated(const Figure& figure, double factor, const std::string& between = "+-") {
  const double value = factor * figure.value;
  const double sigma = std::abs(factor) * figure.sigma;
  if (!(sigma > 0) || !std::isfinite(sigma)) return fmt::format("{:.4g}", value);
  // One digit of the error, two when it starts with a 1.
  const double place = std::floor(std::log10(sigma));
  const double digits = sigma / std::pow(10, place) < 1.95 ? 1 - place : -place;
  const int decimals = static_cast<int>(std::clamp(digits, 0.0, 6.0));
  return fmt::format("{:.{}f} {} {:.{}f}", value, decimals, between, sigma, decimals);
}

}  // namespace aeolian
