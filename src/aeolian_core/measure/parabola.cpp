#include "aeolian_core/measure/parabola.hpp"

#include <cmath>

namespace aeolian {

std::optional<ParabolaVertex> fit_vertex(const std::vector<double>& values, std::size_t first,
                                         std::size_t last) {
  if (last >= values.size() || last < first + 2) return std::nullopt;
  const auto n = static_cast<double>(last - first + 1);
  const double middle = 0.5 * static_cast<double>(first + last);
  double s2 = 0;
  double s4 = 0;
  double y0 = 0;
  double y1 = 0;
  double y2 = 0;
  for (std::size_t i = first; i <= last; ++i) {
    const double u = static_cast<double>(i) - middle;
    s2 += u * u;
    s4 += u * u * u * u;
    y0 += values[i];
    y1 += u * values[i];
    y2 += u * u * values[i];
  }
  const double a = (n * y2 - s2 * y0) / (n * s4 - s2 * s2);
  const double b = y1 / s2;
  const double top = -b / (2 * a);
  if (!(std::abs(top) <= 0.5 * (n - 1))) return std::nullopt;
  return ParabolaVertex{middle + top, (y0 - a * s2) / n + 0.5 * b * top, 2 * a};
}

}  // namespace aeolian
