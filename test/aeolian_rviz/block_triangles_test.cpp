#include "aeolian_rviz/block_triangles.hpp"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

using Edge = std::pair<int, int>;

std::vector<VertexState> whole() {
  return std::vector<VertexState>(block_vertices * block_vertices, VertexState::known);
}
int x_of(int vertex) { return vertex % block_vertices; }
int y_of(int vertex) { return vertex / block_vertices; }

/// Twice the signed area of all triangles, each of which must run counter-clockwise.
double area(const std::vector<std::uint16_t>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const int a = corners[i];
    const int b = corners[i + 1];
    const int c = corners[i + 2];
    const double twice =
        (x_of(b) - x_of(a)) * (y_of(c) - y_of(a)) - (x_of(c) - x_of(a)) * (y_of(b) - y_of(a));
    EXPECT_GT(twice, 0);
    sum += twice;
  }
  return sum;
}

/// Edges that belong to one triangle only: the outline.
std::set<Edge> outline(const std::vector<std::uint16_t>& corners) {
  std::map<Edge, int> uses;
  for (std::size_t i = 0; i < corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corners[i + k];
      const int b = corners[i + (k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  std::set<Edge> single;
  for (const auto& [edge, count] : uses) {
    EXPECT_LE(count, 2);
    if (count == 1) single.insert(edge);
  }
  return single;
}

TEST(DetailLevel, IsTheCoarsestWhoseQuadsAreSmallEnough) {
  EXPECT_EQ(detail_level(10, 3), 0);
  EXPECT_EQ(detail_level(1.6, 3), 0);
  EXPECT_EQ(detail_level(1.5, 3), 1);
  EXPECT_EQ(detail_level(0.75, 3), 2);
  EXPECT_EQ(detail_level(0, 3), coarsest_level);
  EXPECT_EQ(detail_level(INFINITY, 3), 0);
}

TEST(BlockTriangles, CoverTheBlockAtEveryLevelAndSize) {
  for (const auto& [nx, ny] : {Edge{128, 128}, {128, 37}, {2, 2}, {100, 3}})
    for (int level = 0; level <= coarsest_level; ++level) {
      const auto corners = block_triangles(nx, ny, {level, level, level, level, level}, whole());
      EXPECT_EQ(corners.size(), 3 * count_triangles(nx, ny, level));
      EXPECT_EQ(area(corners), 2.0 * (nx - 1) * (ny - 1));
    }
}

TEST(BlockTriangles, OfASingleRowAreNone) {
  EXPECT_TRUE(block_triangles(128, 1, {}, whole()).empty());
  EXPECT_EQ(count_triangles(128, 1, 0), 0U);
}

TEST(BlockTriangles, MeetCoarserNeighboursInTheirVertices) {
  for (int own = 0; own < coarsest_level; ++own)
    for (int beside = own; beside <= coarsest_level; ++beside)
      for (const int ny : {128, 90}) {
        const BlockLevels levels{own, own, beside, beside, own};
        const auto corners = block_triangles(128, ny, levels, whole());
        EXPECT_EQ(area(corners), 2.0 * 127 * (ny - 1)) << "no hole, no overlap";
        const auto neighbour = block_triangles(128, ny, {beside, beside, beside, beside, beside}, whole());
        std::set<Edge> east;
        std::set<Edge> south;
        for (const Edge& e : outline(corners)) {
          if (x_of(e.first) == 127 && x_of(e.second) == 127) east.insert({y_of(e.first), y_of(e.second)});
          if (y_of(e.first) == 0 && y_of(e.second) == 0) south.insert({x_of(e.first), x_of(e.second)});
        }
        std::set<Edge> west_of_neighbour;
        std::set<Edge> north_of_neighbour;
        for (const Edge& e : outline(neighbour)) {
          if (x_of(e.first) == 0 && x_of(e.second) == 0)
            west_of_neighbour.insert({y_of(e.first), y_of(e.second)});
          if (y_of(e.first) == ny - 1 && y_of(e.second) == ny - 1)
            north_of_neighbour.insert({x_of(e.first), x_of(e.second)});
        }
        EXPECT_EQ(east, west_of_neighbour);
        EXPECT_EQ(south, north_of_neighbour);
      }
}

TEST(BlockTriangles, LeaveHolesOpen) {
  auto states = whole();
  for (int y = 10; y < 20; ++y)
    for (int x = 10; x < 20; ++x) states[BlockCells::index(x, y)] = VertexState::none;
  const auto corners = block_triangles(128, 128, {}, states);
  // Two of the hole's corners lie off the diagonal of their quad, whose other triangle stands.
  EXPECT_EQ(area(corners), 2.0 * (127 * 127 - 11 * 11) + 2);
  for (VertexState& state : states) state = VertexState::extended;
  EXPECT_TRUE(block_triangles(128, 128, {}, states).empty()) << "nothing is known";
}

TEST(BlockTriangles, CoarseQuadsStandOnExtendedCorners) {
  auto states = whole();
  states[BlockCells::index(32, 32)] = VertexState::extended;
  EXPECT_EQ(area(block_triangles(128, 128, {4, 4, 4, 4, 4}, states)), 2.0 * 127 * 127);
}

TEST(BlockCells, AreRelativeToTheBaseAndExtendedBesideHoles) {
  const GridGeometry grid(500000, 4e6, 1, 300, 40);
  HeightMap::Layer heights(grid.size(), 1000.5F);
  for (int y = 0; y < 40; ++y)
    for (int x = 200; x < 300; ++x) heights[grid.index(x, y)] = HeightMap::unknown;
  const BlockGrid blocks(grid);
  ASSERT_EQ(blocks.across, 3);
  ASSERT_EQ(blocks.along, 1);
  BlockCells cells;
  cells.take(grid, heights, blocks.ranges[1], blocks.ranges[1], 1000);
  const auto at = [&](int x) { return BlockCells::index(x - blocks.ranges[1].x0, 20); };
  EXPECT_EQ(cells.heights[at(199)], 0.5F);
  EXPECT_EQ(cells.states[at(199)], VertexState::known);
  EXPECT_EQ(cells.heights[at(200)], 0.5F);
  EXPECT_EQ(cells.states[at(200)], VertexState::extended);
  EXPECT_EQ(cells.states[at(199 + extension_cells)], VertexState::extended);
  EXPECT_EQ(cells.states[at(200 + extension_cells)], VertexState::none);
}

TEST(BlockGrid, CoversTheMapAndNeighboursShareARow) {
  for (const int n : {1, 2, 127, 128, 129, 255, 1000}) {
    const BlockGrid blocks(GridGeometry(0, 0, 1, n, 3));
    EXPECT_EQ(blocks.ranges.front().x0, 0);
    EXPECT_EQ(blocks.ranges.back().x1, n);
    for (std::size_t i = 1; i < blocks.ranges.size(); ++i)
      EXPECT_EQ(blocks.ranges[i].x0, blocks.ranges[i - 1].x1 - 1);
  }
}

TEST(ChangedPart, HoldsWhatTheChangedTilesReach) {
  const GridGeometry grid(0, 0, 1, 1000, 1000);
  const BlockGrid blocks(grid);
  TileMask changed(grid);
  EXPECT_FALSE(changed_part(changed, blocks.ranges[0]));
  changed.set_tile(2, 1);  // x 64 to 96, y 32 to 64
  EXPECT_EQ(*changed_part(changed, blocks.ranges[0]), (CellRange{56, 104, 24, 72}));
  EXPECT_FALSE(changed_part(changed, blocks.ranges[1]));
  changed.clear();
  changed.set_tile(4, 4);  // x and y from 128: the extension reaches the blocks before
  EXPECT_EQ(*changed_part(changed, blocks.ranges[0]), (CellRange{120, 128, 120, 128}));
  EXPECT_EQ(*changed_part(TileMask(grid, true), blocks.ranges.back()), blocks.ranges.back());
}

}  // namespace
}  // namespace aeolian
