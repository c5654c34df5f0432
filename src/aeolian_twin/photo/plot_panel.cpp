#include "aeolian_twin/photo/plot_panel.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace aeolian {

PlotRange range_of(const std::vector<double>& values, double air) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const double value : values)
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(low <= high)) return {};
  const double margin = std::max(air * (high - low), 1e-6);
  return {low - margin, high + margin};
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

std::string panel_place(double left, double right, double top, double bottom) {
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen "
      "{}\n",
      left, right, top, bottom);
}

}  // namespace aeolian
