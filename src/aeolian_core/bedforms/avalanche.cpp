#include "aeolian_core/bedforms/avalanche.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

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
  explicit Worklist(const GridGeometry& geometry) : geometry_(geometry), waiting_(geometry.size(), 0) {}
  void push(CellIndex cell) {
    std::uint8_t& waiting = waiting_[geometry_.index(cell)];
    if (waiting) return;
    waiting = 1;
    cells_.push_back(cell);
  }
  bool pop(CellIndex& cell) {
    if (next_ == cells_.size()) return false;
    cell = cells_[next_++];
    waiting_[geometry_.index(cell)] = 0;
    if (next_ > 4096 && 2 * next_ > cells_.size()) {
      cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(next_));
      next_ = 0;
    }
    return true;
  }

 private:
  const GridGeometry& geometry_;
  std::vector<CellIndex> cells_;
  std::vector<std::uint8_t> waiting_;
  std::size_t next_ = 0;
};

/// Works the list off; `height(cell)` is a reference, `touched(cell)` is told of each cell that changed.
/// Returns the sum of the heights moved.
template <class Height, class Touched>
double slide(const GridGeometry& geometry, double tan_repose, bool periodic, Worklist& worklist,
             Height&& height, Touched&& touched) {
  const double straight = tan_repose * geometry.cell();
  const std::array<double, 2> allowed{straight, straight * std::sqrt(2.0)};
  const auto wrap = [](int i, int n) { return i < 0 ? i + n : i >= n ? i - n : i; };
  double moved = 0;
  CellIndex cell;
  while (worklist.pop(cell)) {
    double& from = height(cell);
    bool slid = false;
    for (const Step& step : steps) {
      CellIndex to{cell.x + step.x, cell.y + step.y};
      if (periodic) to = {wrap(to.x, geometry.nx()), wrap(to.y, geometry.ny())};
      if (!geometry.contains(to)) continue;
      double& other = height(to);
      const double limit = allowed[step.x != 0 && step.y != 0];
      const double excess = std::abs(from - other) - limit;
      if (!(excess > tolerance * limit)) continue;
      // Half the excess brings the pair exactly to repose, whichever of the two is the higher.
      const double amount = std::copysign(excess / 2, from - other);
      from -= amount;
      other += amount;
      moved += excess / 2;
      touched(to);
      worklist.push(to);
      slid = true;
    }
    if (!slid) continue;
    touched(cell);
    worklist.push(cell);
  }
  return moved;
}

/// 1 where the slope from a cell to one of the four neighbours ahead, or between two of them, is too steep.
AEOLIAN_KERNEL void mark_steep(std::ptrdiff_t count, double straight, double diagonal,
                               const double* __restrict h, const double* __restrict behind,
                               std::uint8_t* __restrict steep) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double across = std::abs(h[i + 1] - h[i]);
    const double along = std::abs(behind[i] - h[i]);
    const double one = std::abs(behind[i + 1] - h[i]);
    const double other = std::abs(behind[i] - h[i + 1]);
    const double s = across > along ? across : along;
    const double d = one > other ? one : other;
    steep[i] = static_cast<std::uint8_t>((s > straight) | (d > diagonal));
  }
}

}  // namespace

double avalanche(const GridGeometry& geometry, std::vector<double>& height, double tan_repose, bool periodic,
                 TileMask& active) {
  Worklist worklist(geometry);
  active.for_each([&](const CellRange& range) {
    for (int y = range.y0; y < range.y1; ++y)
      for (int x = range.x0; x < range.x1; ++x) worklist.push({x, y});
  });
  const double moved = slide(
      geometry, tan_repose, periodic, worklist,
      [&](CellIndex at) -> double& { return height[geometry.index(at)]; },
      [&](CellIndex at) { active.activate(at.x, at.y); });
  return moved * geometry.cell() * geometry.cell();
}

double avalanche(FrameField& height, int stations, double cell, double tan_repose, bool periodic) {
  const int rows = height.rows();
  const double straight = tan_repose * cell * (1 + tolerance);
  const double diagonal = straight * std::sqrt(2.0);
  const auto width = static_cast<std::size_t>(rows);
  std::vector<std::uint8_t> steep(static_cast<std::size_t>(stations) * width);
  std::vector<std::uint8_t> any(static_cast<std::size_t>(stations), 0);
  tbb::parallel_for(0, stations, [&](int i) {
    std::uint8_t* const marks = &steep[static_cast<std::size_t>(i) * width];
    const int behind = i + 1 < stations ? i + 1 : periodic ? 0 : i;
    mark_steep(rows, straight, diagonal, height.at(i), height.at(behind), marks);
    any[static_cast<std::size_t>(i)] = std::any_of(marks, marks + rows, [](std::uint8_t m) { return m != 0; });
  });
  if (std::none_of(any.begin(), any.end(), [](std::uint8_t m) { return m != 0; })) return 0;

  const GridGeometry geometry(0, 0, cell, rows, stations);
  Worklist worklist(geometry);
  for (int i = 0; i < stations; ++i) {
    if (!any[static_cast<std::size_t>(i)]) continue;
    for (int row = 0; row < rows; ++row)
      if (steep[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(row)])
        // Marks stand for a square of four cells, whose diagonals its two corners in this station see.
        for (const int corner : {row, row + 1 < rows ? row + 1 : periodic ? 0 : row}) worklist.push({corner, i});
  }
  const double moved = slide(
      geometry, tan_repose, periodic, worklist, [&](CellIndex at) -> double& { return height.at(at.y)[at.x]; },
      [](CellIndex) {});
  for (int i = 0; i < stations; ++i) height.fill_pads(i, periodic);
  return moved * cell * cell;
}

}  // namespace aeolian
