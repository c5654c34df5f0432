#include "aeolian_core/twin/translation.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/golden_section.hpp"

namespace aeolian {
namespace {

/// A move of a grid by a vector of cells: where, relative to a cell, the value comes from, and with what
/// weight.
struct Stencil {
  int dx0, dx1, dy0, dy1;
  float wx, wy;  // of dx1 and dy1

  Stencil(double cells_x, double cells_y) {
    const double from_x = std::floor(-cells_x);
    const double from_y = std::floor(-cells_y);
    wx = static_cast<float>(-cells_x - from_x);
    wy = static_cast<float>(-cells_y - from_y);
    dx0 = static_cast<int>(from_x);
    dy0 = static_cast<int>(from_y);
    // A neighbour without weight may be unknown: it must not be asked.
    dx1 = wx > 0 ? dx0 + 1 : dx0;
    dy1 = wy > 0 ? dy0 + 1 : dy0;
  }
};

struct Misfit {
  double sum_of_squares = 0;
  std::size_t cells = 0;
};

Misfit misfit(const GridGeometry& geometry, const HeightMap::Layer& start, const HeightMap::Layer& target,
              const Stencil& from) {
  const int first_x = std::max(0, -from.dx0);
  const int last_x = std::min(geometry.nx(), geometry.nx() - from.dx1);
  const int first_y = std::max(0, -from.dy0);
  const int last_y = std::min(geometry.ny(), geometry.ny() - from.dy1);
  Misfit total;
  for (int y = first_y; y < last_y; ++y) {
    const float* lower = start.data() + geometry.index(0, y + from.dy0);
    const float* upper = start.data() + geometry.index(0, y + from.dy1);
    const float* goal = target.data() + geometry.index(0, y);
    for (int x = first_x; x < last_x; ++x) {
      const float low = lower[x + from.dx0] + from.wx * (lower[x + from.dx1] - lower[x + from.dx0]);
      const float high = upper[x + from.dx0] + from.wx * (upper[x + from.dx1] - upper[x + from.dx0]);
      const double d = static_cast<double>(low + from.wy * (high - low)) - static_cast<double>(goal[x]);
      const bool known = !std::isnan(d);
      total.sum_of_squares += known ? d * d : 0;
      total.cells += known ? 1 : 0;
    }
  }
  return total;
}

}  // namespace

Translation best_translation(const GridGeometry& geometry, const HeightMap::Layer& start,
                             const HeightMap::Layer& target, double direction, double max_shift) {
  const double along_x = std::cos(direction);
  const double along_y = std::sin(direction);
  // To a millionth of a cell: what rounding leaves of cos(pi/2) must not ask a neighbour.
  const auto snapped = [](double cells) { return std::round(cells * 1e6) / 1e6; };
  const auto misfit_at = [&](double cells) {
    return misfit(geometry, start, target, Stencil(snapped(cells * along_x), snapped(cells * along_y)));
  };
  const auto rmse_of = [](const Misfit& m) {
    return std::sqrt(m.sum_of_squares / static_cast<double>(m.cells));
  };

  const Misfit still = misfit_at(0);
  double best_shift = 0;
  double best_rmse = rmse_of(still);
  const auto consider = [&](double cells) {
    const Misfit m = misfit_at(cells);
    const double rmse = 2 * m.cells >= still.cells && m.cells > 0 ? rmse_of(m) : INFINITY;
    if (rmse < best_rmse) {
      best_rmse = rmse;
      best_shift = cells;
    }
    return rmse;
  };

  const double reach = max_shift / geometry.cell();
  const int steps = static_cast<int>(std::ceil(std::min(reach, 12.0)));  // to each side: a ripple is longer
  const double step = steps > 0 ? reach / steps : 0;
  for (int i = 1; i <= steps && best_rmse > 0; ++i) {
    consider(i * step);
    consider(-i * step);
  }

  // Between the neighbours of the best.
  if (best_rmse > 0)
    minimum_between(std::max(best_shift - step, -reach), std::min(best_shift + step, reach), 0.01, consider);
  return {best_shift * geometry.cell(), best_rmse};
}

}  // namespace aeolian
