#include "aeolian_core/slide/piles/pile_measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

template <int Dim>
using CellPlace = std::array<long, static_cast<std::size_t>(Dim)>;

/// The points of the largest set of occupied cells that touch, also at corners.
template <int Dim>
std::vector<Point<Dim>> main_body(const std::vector<Point<Dim>>& points, double link) {
  std::map<CellPlace<Dim>, std::vector<std::size_t>> cells;
  for (std::size_t k = 0; k < points.size(); ++k) {
    CellPlace<Dim> place;
    for (std::size_t d = 0; d < Dim; ++d)
      place[d] = static_cast<long>(std::floor(points[k][static_cast<int>(d)] / link));
    cells[place].push_back(k);
  }
  std::vector<std::size_t> largest;
  std::map<CellPlace<Dim>, bool> seen;
  for (const auto& [start, unused] : cells) {
    if (seen[start]) continue;
    seen[start] = true;
    std::vector<CellPlace<Dim>> open{start};
    std::vector<std::size_t> body;
    while (!open.empty()) {
      const CellPlace<Dim> place = open.back();
      open.pop_back();
      const auto& members = cells.at(place);
      body.insert(body.end(), members.begin(), members.end());
      for (int side = 0; side < (Dim == 2 ? 9 : 27); ++side) {
        CellPlace<Dim> next = place;
        int rest = side;
        for (std::size_t d = 0; d < Dim; ++d) {
          next[d] += rest % 3 - 1;
          rest /= 3;
        }
        if (cells.count(next) == 0 || seen[next]) continue;
        seen[next] = true;
        open.push_back(next);
      }
    }
    if (body.size() > largest.size()) largest.swap(body);
  }
  std::sort(largest.begin(), largest.end());
  std::vector<Point<Dim>> result;
  for (const std::size_t k : largest) result.push_back(points[k]);
  return result;
}

/// Those farthest from the vertical through the centre of mass are taken off.
void take_off_outliers(std::vector<Point<3>>& points, double share) {
  Point<3> centre = Point<3>::Zero();
  for (const Point<3>& p : points) centre += p / static_cast<double>(points.size());
  const auto radius = [&](const Point<3>& p) { return std::hypot(p.x() - centre.x(), p.y() - centre.y()); };
  std::stable_sort(points.begin(), points.end(),
                   [&](const Point<3>& a, const Point<3>& b) { return radius(a) < radius(b); });
  const auto off = static_cast<std::size_t>(share * static_cast<double>(points.size()));
  points.resize(points.size() - off);
}

/// Both ends step inwards together until the share is outside.
void take_off_outliers(std::vector<Point<2>>& points, double share) {
  std::sort(points.begin(), points.end(), [](const Point<2>& a, const Point<2>& b) { return a.x() < b.x(); });
  const auto off = static_cast<std::size_t>(share * static_cast<double>(points.size()));
  constexpr int steps = 2000;
  const double from = points.front().x();
  const double step = (points.back().x() - from) / (2 * steps);
  std::size_t low = 0, high = points.size();
  for (int k = 1; k < steps && low + (points.size() - high) < off; ++k) {
    while (low < high && points[low].x() < from + k * step) ++low;
    while (high > low && points[high - 1].x() > points.back().x() - k * step) --high;
  }
  points = std::vector<Point<2>>(points.begin() + static_cast<std::ptrdiff_t>(low),
                                 points.begin() + static_cast<std::ptrdiff_t>(high));
}

/// The highest point of each column of cells over the box about the points.
template <int Dim>
std::vector<Point<Dim>> shell(const std::vector<Point<Dim>>& points, int cells) {
  Point<Dim> low = points.front(), high = points.front();
  for (const Point<Dim>& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::map<std::array<int, 2>, Point<Dim>> highest;
  for (const Point<Dim>& p : points) {
    std::array<int, 2> column{0, 0};
    for (int d = 0; d + 1 < Dim; ++d)
      column[static_cast<std::size_t>(d)] =
          std::min(cells - 1, static_cast<int>((p[d] - low[d]) / std::max(high[d] - low[d], 1e-300) * cells));
    const auto found = highest.emplace(column, p).first;
    if (p[Dim - 1] > found->second[Dim - 1]) found->second = p;
  }
  std::vector<Point<Dim>> result;
  for (const auto& [column, p] : highest) result.push_back(p);
  return result;
}

}  // namespace

template <int Dim>
PileSize measure_pile(const std::vector<Point<Dim>>& points, const PileRules& rules) {
  constexpr Require require{"pile"};
  require(!points.empty(), "number of points", 0, "at least 1");
  require(rules.link > 0, "link", rules.link, "positive");
  require(rules.trimmed >= 0 && rules.trimmed < 1, "share of outliers", rules.trimmed, "from 0 to below 1");
  require(rules.cells >= 1, "number of cells", rules.cells, "at least 1");
  std::vector<Point<Dim>> level = points;
  const double c = std::cos(rules.ground_tilt), s = std::sin(rules.ground_tilt);
  for (Point<Dim>& p : level) {
    if (!p.allFinite()) throw Error("pile: a point is not finite");
    const double x = p[0], z = p[Dim - 1];
    p[0] = c * x + s * z;
    p[Dim - 1] = -s * x + c * z;
  }
  std::vector<Point<Dim>> body = main_body<Dim>(level, rules.link);
  PileSize size;
  size.points = body.size();
  const auto by_x = [](const Point<Dim>& a, const Point<Dim>& b) { return a[0] < b[0]; };
  const auto raw = std::minmax_element(body.begin(), body.end(), by_x);
  size.raw_length = (*raw.second)[0] - (*raw.first)[0];
  take_off_outliers(body, rules.trimmed);
  const std::vector<Point<Dim>> kept = shell<Dim>(body, rules.cells);
  const auto ends = std::minmax_element(kept.begin(), kept.end(), by_x);
  size.head = (*ends.first)[0];
  size.tail = (*ends.second)[0];
  size.length = size.tail - size.head;
  for (const Point<Dim>& p : kept) size.height = std::max(size.height, p[Dim - 1]);
  return size;
}

std::vector<Point<3>> points_of_map(const HeightMap& map) {
  const GridGeometry& geometry = map.geometry();
  const HeightMap::Layer& top = map.layer(layer::elevation);
  const HeightMap::Layer& ground = map.layer(layer::ground);
  std::vector<Point<3>> points;
  for (int y = 0; y < geometry.ny(); ++y)
    for (int x = 0; x < geometry.nx(); ++x) {
      const std::size_t k = geometry.index(x, y);
      const double depth = static_cast<double>(top[k]) - static_cast<double>(ground[k]);
      if (!std::isfinite(depth)) continue;
      // The uppermost at the surface, so that the pile keeps its height.
      const auto count = static_cast<int>(std::lround(depth / geometry.cell()));
      for (int n = 0; n < count; ++n)
        points.push_back({geometry.x(x), geometry.y(y), depth * (n + 1) / count});
    }
  return points;
}

template PileSize measure_pile(const std::vector<Point<2>>&, const PileRules&);
template PileSize measure_pile(const std::vector<Point<3>>&, const PileRules&);

}  // namespace aeolian
