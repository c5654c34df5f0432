#include "aeolian_core/wind/lee_bubble.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

namespace aeolian {
namespace {

/// A grid turned so that its rows run along the wind, about the middle of the map.
class WindRows {
 public:
  WindRows(const GridGeometry& g, double direction, int longest_bubble)
      : cos_(std::cos(direction)), sin_(std::sin(direction)) {
    // Exact for winds along the axes: then the rows are those of the map.
    if (std::abs(cos_) < 1e-12) cos_ = 0;
    if (std::abs(sin_) < 1e-12) sin_ = 0;
    const auto extent = [&](double c, double s) {
      return static_cast<int>(std::ceil(std::abs(c) * g.nx() + std::abs(s) * g.ny() - 1e-9));
    };
    lead_ = longest_bubble;
    length_ = extent(cos_, sin_) + lead_;
    rows_ = extent(sin_, cos_);
    middle_x_ = 0.5 * (g.nx() - 1);
    middle_y_ = 0.5 * (g.ny() - 1);
  }
  int length() const { return length_; }
  int rows() const { return rows_; }
  /// Cell coordinates of a place in a row, and the inverse.
  std::pair<double, double> cell(int i, int row) const {
    const double along = i - 0.5 * (length_ - lead_ - 1) - lead_;
    const double across = row - 0.5 * (rows_ - 1);
    return {middle_x_ + along * cos_ - across * sin_, middle_y_ + along * sin_ + across * cos_};
  }
  std::pair<double, double> place(double x, double y) const {
    const double along = (x - middle_x_) * cos_ + (y - middle_y_) * sin_;
    const double across = -(x - middle_x_) * sin_ + (y - middle_y_) * cos_;
    return {along + 0.5 * (length_ - lead_ - 1) + lead_, across + 0.5 * (rows_ - 1)};
  }

 private:
  double cos_, sin_, middle_x_, middle_y_;
  int length_, rows_, lead_;
};

/// Bilinear value of a grid at cell coordinates, beyond its border that of the border or of the other side.
double bilinear(const std::vector<double>& grid, int nx, int ny, double x, double y, bool periodic) {
  if (!periodic) {
    x = std::clamp(x, 0.0, nx - 1.0);
    y = std::clamp(y, 0.0, ny - 1.0);
  }
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  const auto fold = [&](double i, int n) {
    const int k = static_cast<int>(i);
    return periodic ? ((k % n) + n) % n : std::min(k, n - 1);
  };
  const double wx = x - fx;
  const double wy = y - fy;
  const auto value = [&](double ix, double iy) {
    return grid[static_cast<std::size_t>(fold(iy, ny)) * static_cast<std::size_t>(nx) +
                static_cast<std::size_t>(fold(ix, nx))];
  };
  double result = (1 - wx) * (1 - wy) * value(fx, fy);
  if (wx > 0) result += wx * (1 - wy) * value(fx + 1, fy);
  if (wy > 0) result += (1 - wx) * wy * value(fx, fy + 1);
  if (wx > 0 && wy > 0) result += wx * wy * value(fx + 1, fy + 1);
  return result;
}

/// Whether any lee falls off steeper than the flow can follow.
bool any_steep_lee(const WindRelief& relief, double direction, double onset) {
  const GridGeometry& g = relief.geometry;
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  std::atomic<bool> found{false};
  tbb::parallel_for(0, g.ny(), [&](int y) {
    for (int x = 0; x < g.nx() && !found; ++x) {
      // One-sided differences are steeper than rows sampled between cells can be.
      const double h = relief.height[g.index(x, y)];
      const auto drop = [&](int dx, int dy) {
        const int ix = relief.periodic ? (x + dx + g.nx()) % g.nx() : std::clamp(x + dx, 0, g.nx() - 1);
        const int iy = relief.periodic ? (y + dy + g.ny()) % g.ny() : std::clamp(y + dy, 0, g.ny() - 1);
        return h - relief.height[g.index(ix, iy)];
      };
      const double fall = std::abs(c) * drop(c > 0 ? 1 : -1, 0) + std::abs(s) * drop(0, s > 0 ? 1 : -1);
      if (fall > 0.7 * onset * g.cell()) found = true;
    }
  });
  return found;
}

}  // namespace

std::vector<std::uint8_t> fill_bubbles(std::vector<double>& height, double spacing, const LeeBubble& bubble) {
  const std::size_t n = height.size();
  std::vector<std::uint8_t> separated(n, 0);
  const double c = bubble.steepest;
  std::size_t i = 1;
  while (i < n) {
    if (height[i] - height[i - 1] > -bubble.onset * spacing) {
      ++i;
      continue;
    }
    // The brink: where the ground began to fall more steeply than the bubble will.
    std::size_t brink = i - 1;
    while (brink > 0 && height[brink] - height[brink - 1] < -c * spacing && !separated[brink]) --brink;
    const double top = height[brink];
    const double slope = brink > 0 ? std::clamp((top - height[brink - 1]) / spacing, -c, c) : 0.0;
    const double a = slope / c;
    const double lengths = 1.5 / c * (1 + a / 4 + a * a / 8);  // over the fall
    // It comes down where the ground is as far away as such a fall is long.
    double lowest = height[i];
    std::size_t end = i;
    while (end + 1 < n && static_cast<double>(end - brink) * spacing < lengths * (top - height[end])) {
      ++end;
      lowest = std::min(lowest, height[end]);
    }
    const double reach = static_cast<double>(end - brink) * spacing;
    const bool lands = reach >= lengths * (top - height[end]);
    const double foot = lands ? height[end] : lowest;
    const double length = std::max(lands ? reach : lengths * (top - foot), spacing);
    const double fall = top - foot;
    for (std::size_t k = brink + 1; k <= end; ++k) {
      const double x = static_cast<double>(k - brink) * spacing / length;
      // The cubic with value `top` and slope `slope` at 0, value `foot` and slope 0 at 1.
      const double cubic =
          foot + fall * (1 - x) * (1 - x) * (1 + 2 * x) + slope * length * x * (1 - x) * (1 - x);
      if (cubic > height[k]) {
        height[k] = cubic;
        separated[k] = 1;
      } else if (k > i) {
        break;  // higher ground
      }
    }
    while (i < n && (separated[i] || i <= brink)) ++i;
    ++i;
  }
  return separated;
}

ShelteredRelief sheltered(WindRelief relief, double direction, const LeeBubble& bubble) {
  if (!any_steep_lee(relief, direction, bubble.onset)) return {std::move(relief), {}};
  const GridGeometry& g = relief.geometry;
  int lead = 0;
  if (relief.periodic) {
    const auto [low, high] = std::minmax_element(relief.height.begin(), relief.height.end());
    const double longest = 2.1 / bubble.steepest * (*high - *low) / g.cell();
    lead = static_cast<int>(std::min(longest, static_cast<double>(g.nx() + g.ny()))) + 1;
  }
  const WindRows rows(g, direction, lead);
  const auto length = static_cast<std::size_t>(rows.length());
  std::vector<double> raised(length * static_cast<std::size_t>(rows.rows()), 0.0);
  std::vector<double> marks(raised.size(), 0.0);
  std::atomic<bool> any{false};
  tbb::parallel_for(0, rows.rows(), [&](int row) {
    std::vector<double> profile(length);
    for (std::size_t i = 0; i < length; ++i) {
      const auto [x, y] = rows.cell(static_cast<int>(i), row);
      profile[i] = bilinear(relief.height, g.nx(), g.ny(), x, y, relief.periodic);
    }
    const std::vector<double> ground = profile;
    const std::vector<std::uint8_t> separated = fill_bubbles(profile, g.cell(), bubble);
    for (std::size_t i = 0; i < length; ++i) {
      if (!separated[i]) continue;
      raised[static_cast<std::size_t>(row) * length + i] = profile[i] - ground[i];
      marks[static_cast<std::size_t>(row) * length + i] = 1;
      any = true;
    }
  });
  if (!any) return {std::move(relief), {}};
  ShelteredRelief result{std::move(relief), std::vector<std::uint8_t>(g.size(), 0)};
  tbb::parallel_for(0, g.ny(), [&](int y) {
    for (int x = 0; x < g.nx(); ++x) {
      const auto [along, across] = rows.place(x, y);
      const std::size_t cell = g.index(x, y);
      result.relief.height[cell] += bilinear(raised, rows.length(), rows.rows(), along, across, false);
      result.separated[cell] = bilinear(marks, rows.length(), rows.rows(), along, across, false) >= 0.5;
    }
  });
  return result;
}

}  // namespace aeolian
