#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {

/// "12.3 ± 0.4 mm": digits as far as the standard error has two; without one three significant digits.
inline std::string figure_words(const Figure& figure, const Unit& unit) {
  const double value = figure.value * unit.factor;
  const double sigma = std::abs(figure.sigma * unit.factor);
  if (std::isnan(value)) return "not available";
  const std::string name = unit.name.empty() ? "" : (unit.name == "°" ? "" : " ") + unit.name;
  if (value == 0 && sigma == 0) return "0" + name;
  const double least = std::isfinite(sigma) && sigma > 0 ? sigma / 10 : std::abs(value) / 1000;
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(least))), 0, 6);
  if (!std::isfinite(sigma)) return fmt::format("{:.{}f}{}", value, decimals, name);
  return fmt::format("{:.{}f} ± {:.{}f}{}", value, decimals, sigma, decimals, name);
}

/// A length in the unit that suits it.
inline std::string length_words(const Figure& figure) {
  const double size = std::abs(figure.value);
  return figure_words(figure, length_unit(std::isfinite(size) && size > 0 ? size : 0.001));
}

}  // namespace aeolian
