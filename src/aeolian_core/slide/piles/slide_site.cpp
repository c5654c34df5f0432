#include "aeolian_core/slide/piles/slide_site.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

constexpr double gravity = 9.81;  ///< [m/s^2]

/// The rectangle that counts, in the slide's axes [m].
struct Area {
  double x0, x1, half_width;
};

double value_at(const HeightMap& map, const std::string& name, const SlideSite& site, const Point<2>& slide) {
  const Point<2> at = site.to_map(slide);
  return sample(map.geometry(), map.layer(name), at.x(), at.y());
}

double lowest_known(const HeightMap& map) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const float z : map.layer(layer::elevation))
    if (std::isfinite(z)) lowest = std::min(lowest, static_cast<double>(z));
  if (!std::isfinite(lowest)) throw Error("ground: no cell of the map is known");
  return lowest;
}

/// How far a block flies beyond the lower edge that has slid down all of the panel [m].
double flight(const HeightMap& map, const SlideScene& scene, const SlideSite& site) {
  const double c = std::cos(scene.tilt), s = std::sin(scene.tilt);
  const double square =
      2 * gravity * scene.panel_length * std::max(s - scene.panel_friction * c, 0.0);  // of its speed
  const double edge = 0.5 * scene.panel_length * c;
  const double lowest = lowest_known(map);
  if (square == 0) return 0;
  for (double way = 0;; way += scene.cell) {
    const double z = scene.lower_edge() - way * s / c - 0.5 * gravity * way * way / (square * c * c);
    const double ground = value_at(map, layer::elevation, site, {edge + way, 0});
    if (z <= (std::isfinite(ground) ? ground : lowest)) return way;
  }
}

Area area_of(const HeightMap& map, const SlideScene& scene, const SlideSite& site, int dimensions) {
  const double edge = 0.5 * scene.panel_length * std::cos(scene.tilt);
  return {-edge, edge + flight(map, scene, site) + 0.5 * scene.panel_length,
          dimensions == 3 ? scene.panel_width : 0};
}

GridGeometry grid_of(const Area& area, double cell) {
  const int nx = static_cast<int>(std::ceil((area.x1 - area.x0) / cell)) + 1;
  const int half = static_cast<int>(std::ceil(area.half_width / cell));
  return {area.x0, -(half + 0.5) * cell, cell, nx, 2 * half + 1};
}

/// Whether a cell at most `reach` cells away along both axes is marked.
bool near_any(const GridGeometry& grid, const std::vector<char>& marks, CellIndex at, int reach) {
  for (int y = std::max(at.y - reach, 0); y <= std::min(at.y + reach, grid.ny() - 1); ++y)
    for (int x = std::max(at.x - reach, 0); x <= std::min(at.x + reach, grid.nx() - 1); ++x)
      if (marks[grid.index(x, y)]) return true;
  return false;
}

}  // namespace

Point<2> SlideSite::to_map(const Point<2>& slide) const {
  const double c = std::cos(direction), s = std::sin(direction);
  return {x + c * slide.x() - s * slide.y(), y + s * slide.x() + c * slide.y()};
}

Point<2> SlideSite::to_slide(const Point<2>& map) const {
  const double c = std::cos(direction), s = std::sin(direction);
  const double dx = map.x() - x, dy = map.y() - y;
  return {c * dx + s * dy, -s * dx + c * dy};
}

bool hidden_by_panel(const SlideScene& scene, const Point<2>& slide, double elevation) {
  const double edge = 0.5 * scene.panel_length * std::cos(scene.tilt) + scene.cell;
  if (std::abs(slide.x()) > edge || std::abs(slide.y()) > 0.5 * scene.panel_width + scene.cell) return false;
  const Point<3> centre = panel_frame<3>(scene).centre;
  const double face = centre.z() - slide.x() * std::tan(scene.tilt);
  return elevation > face - panel_thickness(scene) / std::cos(scene.tilt) - scene.cell;
}

SiteGround ground_of_site(const HeightMap& map, const SlideScene& scene, const SlideSite& site,
                          int dimensions, double most_unknown) {
  const Area area = area_of(map, scene, site, dimensions);
  SiteGround ground{HeightMap(grid_of(area, scene.cell))};
  const GridGeometry& grid = ground.map.geometry();
  HeightMap::Layer heights(grid.size()), variances(grid.size(), HeightMap::unknown);
  std::vector<char> panel(grid.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const CellIndex at = grid.cell_at(k);
    const Point<2> place(grid.x(at.x), grid.y(at.y));
    heights[k] = static_cast<float>(value_at(map, layer::elevation, site, place));
    if (map.has(layer::variance))
      variances[k] = static_cast<float>(value_at(map, layer::variance, site, place));
    panel[k] = hidden_by_panel(scene, place, static_cast<double>(heights[k])) ? 1 : 0;
  }
  // Beside what is panel the map mixes panel and ground.
  const int mixed = static_cast<int>(std::ceil(1.5 * map.geometry().cell() / grid.cell()));
  std::size_t unknown = 0, hidden = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (near_any(grid, panel, grid.cell_at(k), mixed)) {
      heights[k] = HeightMap::unknown;
      ++hidden;
    } else if (!std::isfinite(heights[k])) {
      ++unknown;
    }
  }
  const double share = static_cast<double>(unknown) / static_cast<double>(heights.size());
  if (share > most_unknown || unknown + hidden == heights.size())
    throw Error(fmt::format(
        "ground: {:.0f} % of the {:.2f} m x {:.2f} m about ({:g}, {:g}) m where snow may land is not known, "
        "must be at most {:.0f} %",
        100 * share, grid.length_x(), grid.length_y(), site.x, site.y, 100 * most_unknown));
  ground.map.add(layer::elevation, filled(grid, heights));
  ground.map.add(layer::variance, filled(grid, variances));
  ground.guessed = static_cast<double>(unknown + hidden) / static_cast<double>(heights.size());
  return ground;
}

namespace {

/// The cells of the map's grid that a pile may cover.
GridGeometry part_under(const GridGeometry& map, const SlideSite& site, const GridGeometry& pile,
                        double half_width) {
  Point<2> low = Point<2>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const double x : {pile.origin_x(), pile.origin_x() + pile.length_x()})
    for (const double y :
         {std::min(pile.origin_y(), -half_width), std::max(pile.origin_y() + pile.length_y(), half_width)}) {
      low = low.cwiseMin(site.to_map({x, y}));
      high = high.cwiseMax(site.to_map({x, y}));
    }
  const auto first = [&](double at, double origin, int count) {
    return std::clamp(static_cast<int>(std::floor((at - origin) / map.cell())), 0, count - 1);
  };
  const int x0 = first(low.x(), map.origin_x(), map.nx()), x1 = first(high.x(), map.origin_x(), map.nx());
  const int y0 = first(low.y(), map.origin_y(), map.ny()), y1 = first(high.y(), map.origin_y(), map.ny());
  return {map.origin_x() + x0 * map.cell(), map.origin_y() + y0 * map.cell(), map.cell(), x1 - x0 + 1,
          y1 - y0 + 1};
}

}  // namespace

HeightMap site_patch(const HeightMap& map, const SlideScene& scene, const SlideSite& site,
                     const HeightMap& pile, const HeightMap& bare, int dimensions, double model_error) {
  const GridGeometry& local = pile.geometry();
  const double half_slab = dimensions == 2 ? 0.5 * scene.slab_width : 0;
  HeightMap patch(part_under(map.geometry(), site, local, half_slab));
  const GridGeometry& grid = patch.geometry();
  HeightMap::Layer depths = pile.layer(layer::elevation);
  for (std::size_t k = 0; k < depths.size(); ++k) depths[k] -= pile.layer(layer::ground)[k];
  HeightMap::Layer& top = patch.add(layer::elevation);
  HeightMap::Layer& ground = patch.add(layer::ground);
  HeightMap::Layer& variance = patch.add(layer::variance);
  const auto square = [](double a) { return a * a; };
  for (std::size_t k = 0; k < top.size(); ++k) {
    const CellIndex at = grid.cell_at(k);
    const Point<2> place = site.to_slide({grid.x(at.x), grid.y(at.y)});
    if (dimensions == 2 && std::abs(place.y()) > half_slab) continue;
    const double along_y = dimensions == 2 ? local.y(0) : place.y();
    const double depth = sample(local, depths, place.x(), along_y);
    if (!(depth >= 0.5 * scene.cell)) continue;
    const double floor = sample(local, pile.layer(layer::ground), place.x(), along_y);
    const auto there = map.geometry().find(grid.x(at.x), grid.y(at.y));
    const std::size_t in_map = map.geometry().index(*there);
    const double seen = static_cast<double>(map.layer(layer::elevation)[in_map]);
    if (hidden_by_panel(scene, place, seen)) continue;
    ground[k] = static_cast<float>(floor);
    top[k] = static_cast<float>(floor + depth);
    const HeightMap::Layer& of_ground = bare.layer(layer::variance);
    variance[k] = static_cast<float>(sample(bare.geometry(), of_ground, place.x(), along_y) +
                                     sample(local, pile.layer(layer::variance), place.x(), along_y) +
                                     square(model_error * depth));
  }
  return patch;
}

}  // namespace aeolian
