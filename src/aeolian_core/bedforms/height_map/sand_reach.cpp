#include "aeolian_core/bedforms/height_map/sand_reach.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/height_map/sweep_bundle.hpp"

namespace aeolian {
namespace {

constexpr int spare = 40;    ///< that sand may creep, and more than a patch
constexpr int in_work = 12;  ///< stations that a sweep is ahead of what it does

}  // namespace

SandReach::SandReach(const GridGeometry& geometry, double direction, double hop, int aside, double tangent)
    : geometry_(geometry),
      drop_(geometry.cell() * tangent),
      downwind_(std::ceil(-std::log(least_flux) * hop / geometry.cell()) + in_work),
      aside_(aside + in_work),
      along_x_(std::cos(direction)),
      along_y_(std::sin(direction)) {}

std::optional<CellRange> SandReach::range(const std::vector<double>& height, const std::vector<double>& floor,
                                          const std::vector<double>& dune) const {
  const GridGeometry& g = geometry_;
  CellRange sand{g.nx(), 0, g.ny(), 0};
  double low = height[0] - dune[0];
  double high = low;
  for (int y = 0; y < g.ny(); ++y) {
    const std::size_t row = g.index(0, y);
    const auto can_move = [&](int x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      return height[i] - floor[i] > least_movable;
    };
    int first = 0;
    while (first < g.nx() && !can_move(first)) ++first;
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      low = std::min(low, height[i] - dune[i]);
      high = std::max(high, height[i] - dune[i]);
    }
    if (first == g.nx()) continue;
    int last = g.nx() - 1;
    while (!can_move(last)) --last;
    sand = {std::min(sand.x0, first), std::max(sand.x1, last + 1), std::min(sand.y0, y), y + 1};
  }
  if (sand.x0 >= sand.x1) return std::nullopt;
  const double shade = std::ceil((high - low) / drop_) + in_work;
  const auto widen = [&](double along, int size, int& begin, int& end) {
    const double with = std::max(along, 0.0);
    const double against = std::max(-along, 0.0);
    const double ahead = downwind_ * with + shade * against + aside_ + spare;
    const double back = downwind_ * against + shade * with + aside_ + spare;
    begin = static_cast<int>(std::max(0.0, begin - back));
    end = static_cast<int>(std::min<double>(size, end + ahead));
  };
  widen(along_x_, g.nx(), sand.x0, sand.x1);
  widen(along_y_, g.ny(), sand.y0, sand.y1);
  return sand;
}

bool SandReach::stays_within(const WindFrame& part, const ActivePatches& sandy) const {
  const WindFrame::Rim& rim = part.rim();
  if (!rim.any()) return true;
  const double along = downwind_ / std::hypot(1, part.drift());
  const double to_high_rows = aside_ + std::max(0.0, along * part.drift());
  const double to_low_rows = aside_ + std::max(0.0, -along * part.drift());
  for (int station = 0; station < part.stations(); ++station) {
    bool leaves = false;
    sandy.for_runs(station, [&](int begin, int end) {
      leaves = leaves || (rim.upwind && station < aside_) ||
               (rim.downwind && station + along + aside_ >= part.stations()) ||
               (rim.low_rows && begin < to_low_rows) || (rim.high_rows && end + to_high_rows > part.rows());
    });
    if (leaves) return false;
  }
  return true;
}

}  // namespace aeolian
