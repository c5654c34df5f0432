#include "aeolian_rviz/block_triangles.hpp"

#include <algorithm>

namespace aeolian {
namespace {

/// Where the rows or columns of a level lie: multiples of the stride, and the last.
std::vector<int> lines(int count, int level) {
  std::vector<int> result;
  for (int i = 0; i < count - 1; i += 1 << level) result.push_back(i);
  result.push_back(count - 1);
  return result;
}

/// The vertex of an edge of the given level that stands for vertex i.
int drawn_in(int i, int count, int level) { return i == count - 1 ? i : i >> level << level; }

bool holds_known_cell(const std::vector<VertexState>& states, int x0, int x1, int y0, int y1) {
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (states[BlockCells::index(x, y)] == VertexState::known) return true;
  return false;
}

}  // namespace

int detail_level(double cell_pixels, double quad_pixels) {
  int level = 0;
  while (level < coarsest_level && cell_pixels * (2 << level) <= quad_pixels) ++level;
  return level;
}

std::vector<std::uint16_t> block_triangles(int nx, int ny, const BlockLevels& levels,
                                           const std::vector<VertexState>& states) {
  const int west = std::max(levels.west, levels.own);
  const int east = std::max(levels.east, levels.own);
  const int south = std::max(levels.south, levels.own);
  const int north = std::max(levels.north, levels.own);
  const auto vertex = [&](int x, int y) {
    const int edge_x = y == 0 ? south : y == ny - 1 ? north : levels.own;
    const int edge_y = x == 0 ? west : x == nx - 1 ? east : levels.own;
    return static_cast<std::uint16_t>(BlockCells::index(drawn_in(x, nx, edge_x), drawn_in(y, ny, edge_y)));
  };
  std::vector<std::uint16_t> corners;
  if (nx < 2 || ny < 2) return corners;
  corners.reserve(3 * count_triangles(nx, ny, levels.own));
  const auto triangle = [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    if (a == b || b == c || a == c) return;
    for (const std::uint16_t corner : {a, b, c})
      if (states[corner] == VertexState::none) return;
    corners.insert(corners.end(), {a, b, c});
  };
  const std::vector<int> xs = lines(nx, levels.own);
  const std::vector<int> ys = lines(ny, levels.own);
  for (std::size_t j = 0; j + 1 < ys.size(); ++j)
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      if (!holds_known_cell(states, xs[i], xs[i + 1], ys[j], ys[j + 1])) continue;
      const std::uint16_t sw = vertex(xs[i], ys[j]);
      const std::uint16_t se = vertex(xs[i + 1], ys[j]);
      const std::uint16_t nw = vertex(xs[i], ys[j + 1]);
      const std::uint16_t ne = vertex(xs[i + 1], ys[j + 1]);
      triangle(sw, se, ne);
      triangle(sw, ne, nw);
    }
  return corners;
}

std::size_t count_triangles(int nx, int ny, int level) {
  const auto quads = [level](int count) { return static_cast<std::size_t>((count - 2) >> level) + 1; };
  return nx < 2 || ny < 2 ? 0 : 2 * quads(nx) * quads(ny);
}

}  // namespace aeolian
