#include "aeolian_core/bedforms/avalanche.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace aeolian {
namespace {

/// A slope is let alone until it exceeds repose by this share.
constexpr double tolerance = 1e-3;

struct Step {
  int x, y;
};
constexpr std::array<Step, 8> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

/// Cells that wait to be looked at, each at most once at a time.
class Worklist {
 public:
  explicit Worklist(std::size_t cells) : waiting_(cells, 0) {}
  void push(CellIndex cell, std::size_t index) {
    if (waiting_[index]) return;
    waiting_[index] = 1;
    cells_.push_back(cell);
  }
  bool pop(CellIndex& cell, const GridGeometry& geometry) {
    if (next_ == cells_.size()) return false;
    cell = cells_[next_++];
    waiting_[geometry.index(cell)] = 0;
    if (next_ > 4096 && 2 * next_ > cells_.size()) {
      cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(next_));
      next_ = 0;
    }
    return true;
  }

 private:
  std::vector<CellIndex> cells_;
  std::vector<std::uint8_t> waiting_;
  std::size_t next_ = 0;
};

}  // namespace

double avalanche(const GridGeometry& geometry, std::vector<double>& height, double tan_repose, bool periodic,
                 TileMask& active) {
  const double straight = tan_repose * geometry.cell();
  const std::array<double, 2> allowed{straight, straight * std::sqrt(2.0)};
  const auto wrap = [](int i, int n) { return i < 0 ? i + n : i >= n ? i - n : i; };

  Worklist worklist(height.size());
  active.for_each([&](const CellRange& range) {
    for (int y = range.y0; y < range.y1; ++y)
      for (int x = range.x0; x < range.x1; ++x) worklist.push({x, y}, geometry.index(x, y));
  });

  double moved = 0;
  CellIndex cell;
  while (worklist.pop(cell, geometry)) {
    const std::size_t from = geometry.index(cell);
    bool slid = false;
    for (const Step& step : steps) {
      CellIndex to{cell.x + step.x, cell.y + step.y};
      if (periodic) to = {wrap(to.x, geometry.nx()), wrap(to.y, geometry.ny())};
      if (!geometry.contains(to)) continue;
      const std::size_t other = geometry.index(to);
      const double limit = allowed[step.x != 0 && step.y != 0];
      const double excess = std::abs(height[from] - height[other]) - limit;
      if (!(excess > tolerance * limit)) continue;
      // Half the excess brings the pair exactly to repose, whichever of the two is the higher.
      const double amount = std::copysign(excess / 2, height[from] - height[other]);
      height[from] -= amount;
      height[other] += amount;
      moved += excess / 2;
      active.activate(cell.x, cell.y);
      active.activate(to.x, to.y);
      worklist.push(to, other);
      slid = true;
    }
    if (slid) worklist.push(cell, from);
  }
  return moved * geometry.cell() * geometry.cell();
}

}  // namespace aeolian
