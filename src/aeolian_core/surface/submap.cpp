#include "aeolian_core/surface/submap.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

std::string told(const CellRange& r) {
  return "x " + std::to_string(r.x0) + " to " + std::to_string(r.x1) + ", y " + std::to_string(r.y0) +
         " to " + std::to_string(r.y1);
}

void require_inside(const CellRange& r, const GridGeometry& grid) {
  if (0 <= r.x0 && r.x0 < r.x1 && r.x1 <= grid.nx() && 0 <= r.y0 && r.y0 < r.y1 && r.y1 <= grid.ny()) return;
  throw Error("part of a map: cells " + told(r) + ", must be some of " + std::to_string(grid.nx()) + " x " +
              std::to_string(grid.ny()));
}

/// Calls with where each row starts in the part and in the whole.
template <class CopyRow>
void for_each_row(const GridGeometry& part, const CellRange& range, const GridGeometry& whole,
                  CopyRow&& copy) {
  for (int y = range.y0; y < range.y1; ++y)
    copy(static_cast<std::ptrdiff_t>(part.index(0, y - range.y0)),
         static_cast<std::ptrdiff_t>(whole.index(range.x0, y)));
}

}  // namespace

GridGeometry part_of(const GridGeometry& whole, const CellRange& range) {
  require_inside(range, whole);
  return {whole.origin_x() + range.x0 * whole.cell(), whole.origin_y() + range.y0 * whole.cell(),
          whole.cell(), range.x1 - range.x0, range.y1 - range.y0};
}

HeightMap::Layer part_of(const GridGeometry& whole, const HeightMap::Layer& values, const CellRange& range) {
  const GridGeometry part = part_of(whole, range);
  HeightMap::Layer result(part.size());
  for_each_row(part, range, whole, [&](std::ptrdiff_t in_part, std::ptrdiff_t in_whole) {
    std::copy_n(values.begin() + in_whole, part.nx(), result.begin() + in_part);
  });
  return result;
}

HeightMap submap(const HeightMap& map, const CellRange& range) {
  HeightMap part(part_of(map.geometry(), range));
  for (const std::string& name : map.names()) part.add(name, part_of(map.geometry(), map.layer(name), range));
  return part;
}

std::optional<CellRange> range_within(const GridGeometry& part, const GridGeometry& whole) {
  constexpr double negligible = 0.01;
  const double x = (part.origin_x() - whole.origin_x()) / whole.cell();
  const double y = (part.origin_y() - whole.origin_y()) / whole.cell();
  const double ratio = part.cell() / whole.cell();
  const auto off_border = [](double position) { return std::abs(position - std::round(position)); };
  const auto stretch = [&](int cells) { return std::abs(ratio - 1) * cells; };
  if (!(x > -0.5 && y > -0.5 && x < whole.nx() && y < whole.ny())) return std::nullopt;
  if (off_border(x) > negligible || off_border(y) > negligible || stretch(part.nx()) > negligible ||
      stretch(part.ny()) > negligible)
    return std::nullopt;
  const int x0 = static_cast<int>(std::lround(x));
  const int y0 = static_cast<int>(std::lround(y));
  if (part.nx() > whole.nx() - x0 || part.ny() > whole.ny() - y0) return std::nullopt;
  return CellRange{x0, x0 + part.nx(), y0, y0 + part.ny()};
}

void paste(const HeightMap& part, const CellRange& at, HeightMap& whole) {
  require_inside(at, whole.geometry());
  const int width = part.geometry().nx();
  if (width != at.x1 - at.x0 || part.geometry().ny() != at.y1 - at.y0)
    throw Error("part of a map: " + std::to_string(width) + " x " + std::to_string(part.geometry().ny()) +
                " cells for cells " + told(at));
  for (const std::string& name : part.names()) {
    if (!whole.has(name)) continue;
    const HeightMap::Layer& from = part.layer(name);
    HeightMap::Layer& to = whole.layer(name);
    for_each_row(part.geometry(), at, whole.geometry(), [&](std::ptrdiff_t in_part, std::ptrdiff_t in_whole) {
      std::copy_n(from.begin() + in_part, width, to.begin() + in_whole);
    });
  }
}

}  // namespace aeolian
