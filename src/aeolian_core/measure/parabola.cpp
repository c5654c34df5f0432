#include "aeolian_core/measure/parabola.hpp"

#include <cmath>

namespace aeolian {
namespace {

/// Sums over samples at u = -(n - 1) / 2 ... (n - 1) / 2.
struct Moments {
  double n = 0;
  double middle = 0;
  double s2 = 0;  ///< of u^2
  double s4 = 0;
  double s6 = 0;
  double y0 = 0;  ///< of the values
  double y1 = 0;  ///< of u times the values
  double y2 = 0;
  double y3 = 0;

  Moments(const std::vector<double>& values, std::size_t first, std::size_t last)
      : n(static_cast<double>(last - first + 1)), middle(0.5 * static_cast<double>(first + last)) {
    for (std::size_t i = first; i <= last; ++i) {
      const double u = static_cast<double>(i) - middle;
      const double uu = u * u;
      s2 += uu;
      s4 += uu * uu;
      s6 += uu * uu * uu;
      y0 += values[i];
      y1 += u * values[i];
      y2 += uu * values[i];
      y3 += uu * u * values[i];
    }
  }
};

/// The extremum of c + b u + a u^2 + e u^3 that continues that of the parabola.
std::optional<Vertex> extremum(const Moments& m, double c, double b, double a, double e) {
  const double root = std::sqrt(a * a - 3 * e * b);
  const double top = -b / (a + std::copysign(root, a));
  if (!(std::abs(top) <= 0.5 * (m.n - 1))) return std::nullopt;
  return Vertex{m.middle + top, c + top * (b + top * (a + top * e)), 2 * a + 6 * e * top};
}

bool enough(const std::vector<double>& values, std::size_t first, std::size_t last, std::size_t least) {
  return last < values.size() && last + 1 >= first + least;
}

}  // namespace

std::optional<Vertex> parabola_vertex(const std::vector<double>& values, std::size_t first,
                                      std::size_t last) {
  if (!enough(values, first, last, 3)) return std::nullopt;
  const Moments m(values, first, last);
  const double a = (m.n * m.y2 - m.s2 * m.y0) / (m.n * m.s4 - m.s2 * m.s2);
  return extremum(m, (m.y0 - a * m.s2) / m.n, m.y1 / m.s2, a, 0);
}

std::optional<Vertex> cubic_vertex(const std::vector<double>& values, std::size_t first, std::size_t last) {
  if (!enough(values, first, last, 4)) return std::nullopt;
  const Moments m(values, first, last);
  const double a = (m.n * m.y2 - m.s2 * m.y0) / (m.n * m.s4 - m.s2 * m.s2);
  const double e = (m.s2 * m.y3 - m.s4 * m.y1) / (m.s2 * m.s6 - m.s4 * m.s4);
  return extremum(m, (m.y0 - a * m.s2) / m.n, (m.y1 - e * m.s4) / m.s2, a, e);
}

}  // namespace aeolian
