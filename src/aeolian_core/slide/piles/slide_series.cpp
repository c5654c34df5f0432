#include "aeolian_core/slide/piles/slide_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <Eigen/LU>
#include <fmt/format.h>

#include "aeolian_core/slide/mpm/snow_body.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double frame_time = 1. / 24;  ///< between looks at the snow [s]
constexpr double near_slabs = 3;        ///< snow this near to the panel is on it

template <int Dim>
double total_mass(const std::vector<MaterialPoint<Dim>>& snow) {
  double mass = 0;
  for (const auto& p : snow) mass += p.mass;
  return mass;
}

/// Mass over the volume that the particles have now: elastic and plastic change of volume.
template <int Dim>
double mean_density(const SnowLaw& law, const std::vector<MaterialPoint<Dim>>& snow) {
  double mass = 0, volume = 0;
  for (const auto& p : snow) {
    mass += p.mass;
    volume += p.volume * std::sqrt(p.b.determinant()) * std::exp(law.initial_compaction() - p.alpha);
  }
  return mass / volume;
}

/// Of a point over the ground, vertically [m].
template <int Dim>
double height_over(const Shape<Dim>& ground, const Point<Dim>& point) {
  const Nearness<Dim> near = ground.at(point);
  return near.distance / near.normal[Dim - 1];
}

template <int Dim>
MpmSettings settings_of(const SlideScene& scene) {
  MpmSettings settings;
  settings.cell = scene.cell;
  settings.transfer = scene.transfer;
  settings.threads = scene.threads;
  return settings;
}

}  // namespace

template <int Dim>
bool on_panel(const SlideScene& scene, const Point<Dim>& place) {
  const PanelFrame<Dim> frame = panel_frame<Dim>(scene);
  const Point<Dim> local = frame.axes.transpose() * (place - frame.centre);
  const bool over = std::abs(local[0]) <= 0.5 * scene.panel_length &&
                    (Dim == 2 || std::abs(local[1]) <= 0.5 * scene.panel_width);
  return over && local[Dim - 1] >= 0 && local[Dim - 1] <= near_slabs * scene.slab_thickness;
}

template <int Dim>
SlideSeries<Dim>::SlideSeries(const SlideScene& scene) : scene_(scene) {
  check(scene, Dim);
}

template <int Dim>
void SlideSeries<Dim>::go_on(const SlideScene& scene) {
  check(scene, Dim);
  scene_ = scene;
}

template <int Dim>
std::optional<SlideEvent<Dim>> SlideSeries<Dim>::next(const Watch& watch) {
  MaterialPoints<Dim> world(settings_of<Dim>(scene_), scene_.snow, obstacles_of<Dim>(scene_));
  world.add(pile_);
  const auto slab = slab_of<Dim>(scene_, events_);
  world.add(slab);
  SlideEvent<Dim> event;
  event.number = events_ + 1;
  double on = 1;    // share of the slab that is on the panel
  double calm = 0;  // how long the snow has been still [s]
  while (world.time() < scene_.longest) {
    world.advance(frame_time);
    event.fastest = std::max(event.fastest, world.fastest());
    if (watch && !watch({event.number, world.time(), world})) return std::nullopt;
    calm = world.fastest() < scene_.still ? calm + frame_time : 0;
    if (calm < scene_.still_for) continue;
    event.snow = world.points();
    const auto there =
        std::count_if(event.snow.begin() + static_cast<std::ptrdiff_t>(pile_.size()), event.snow.end(),
                      [&](const auto& p) { return on_panel<Dim>(scene_, p.place); });
    on = static_cast<double>(there) / static_cast<double>(slab.size());
    event.still = on < 0.5;
    if (event.still || world.time() > scene_.stuck_after) break;
  }
  event.snow = world.points();
  if (!event.still && on > 0.5 && world.fastest() < scene_.still)
    throw Error(
        fmt::format("slide: the slab of event {} is stuck on the panel after {:.2g} s: friction {:g} on {:g} "
                    "degrees, or the "
                    "pile in front, holds it",
                    event.number, world.time(), scene_.panel_friction, scene_.tilt * 180 / M_PI));
  event.duration = world.time();
  event.work = world.work();
  const auto kept = std::stable_partition(event.snow.begin(), event.snow.end(),
                                          [&](const auto& p) { return !on_panel<Dim>(scene_, p.place); });
  for (auto p = kept; p != event.snow.end(); ++p) event.left_behind += p->mass;
  event.snow.erase(kept, event.snow.end());
  if (event.snow.empty())
    throw Error(fmt::format("slide: nothing has left the panel in event {}", event.number));
  event.mass = total_mass(event.snow);
  event.density = mean_density(scene_.snow, event.snow);
  std::vector<Point<Dim>> places;
  const auto ground = obstacles_of<Dim>(scene_).back().shape;
  for (const auto& p : event.snow) {
    places.push_back(p.place);
    places.back()[Dim - 1] = height_over(*ground, p.place);
  }
  event.pile = measure_pile<Dim>(places, scene_.rules());
  pile_ = carried_over(event.snow);
  ++events_;
  return event;
}

template <int Dim>
std::vector<MaterialPoint<Dim>> SlideSeries<Dim>::carried_over(
    const std::vector<MaterialPoint<Dim>>& snow) const {
  std::vector<MaterialPoint<Dim>> result = snow;
  if (scene_.between == SlideScene::Between::keep) {
    for (auto& p : result) {
      p.velocity.setZero();
      p.affine.setZero();
    }
    return result;
  }
  std::set<std::array<long, 3>> cells;
  for (const auto& p : snow) {
    std::array<long, 3> place{0, 0, 0};
    for (int d = 0; d < Dim; ++d)
      place[static_cast<std::size_t>(d)] = static_cast<long>(std::floor(p.place[d] / scene_.cell));
    cells.insert(place);
  }
  result.clear();
  for (const auto& place : cells) {
    SnowBox<Dim> box;
    for (int d = 0; d < Dim; ++d)
      box.corner[d] = static_cast<double>(place[static_cast<std::size_t>(d)]) * scene_.cell;
    box.size = Point<Dim>::Constant(scene_.cell);
    for (const auto& p : filled_box(box, scene_.snow, scene_.cell, scene_.particles_per_cell))
      result.push_back(p);
  }
  const double mass = total_mass(snow) / static_cast<double>(result.size());
  for (auto& p : result) p.mass = mass;
  return result;
}

template <int Dim>
HeightMap pile_map(const SlideScene& scene, const std::vector<MaterialPoint<Dim>>& snow, double cell) {
  if (snow.empty()) throw Error("pile: there are 0 particles, must be at least 1");
  Point<Dim> low = snow.front().place, high = low;
  for (const auto& p : snow) {
    low = low.cwiseMin(p.place);
    high = high.cwiseMax(p.place);
  }
  const double y0 = Dim == 3 ? low[1] : -0.5 * cell;
  const double y1 = Dim == 3 ? high[1] : 0.5 * cell;
  HeightMap map(Dim == 3 ? GridGeometry::covering(low[0], y0, high[0], y1, cell)
                         : GridGeometry(std::floor(low[0] / cell) * cell, y0, cell,
                                        static_cast<int>(std::ceil((high[0] - low[0]) / cell)) + 1, 1));
  const GridGeometry& geometry = map.geometry();
  HeightMap::Layer& ground = map.add(layer::ground);
  const auto floor = obstacles_of<Dim>(scene).back().shape;
  for (int y = 0; y < geometry.ny(); ++y)
    for (int x = 0; x < geometry.nx(); ++x) {
      Point<Dim> place = Point<Dim>::Zero();
      place[0] = geometry.x(x);
      if constexpr (Dim == 3) place[1] = geometry.y(y);
      ground[geometry.index(x, y)] = static_cast<float>(-height_over(*floor, place));
    }
  HeightMap::Layer& top = map.add(layer::elevation, ground);
  HeightMap::Layer bottom(top.size(), std::numeric_limits<float>::infinity());
  for (const auto& p : snow) {
    const auto at = geometry.find(p.place[0], Dim == 3 ? p.place[1] : 0);
    if (!at) continue;
    const std::size_t k = geometry.index(*at);
    const double half_size = 0.5 * std::pow(p.volume, 1. / Dim);
    top[k] = std::max(top[k], static_cast<float>(p.place[Dim - 1] + half_size));
    bottom[k] = std::min(bottom[k], static_cast<float>(p.place[Dim - 1] - half_size));
  }
  // The solver holds snow up to a cell of its grid above what it lies on; there is no such gap.
  const auto cell_of_grid = static_cast<float>(scene.cell);
  for (std::size_t k = 0; k < top.size(); ++k)
    if (top[k] > ground[k]) top[k] -= std::clamp(bottom[k] - ground[k], 0.0F, cell_of_grid);
  // What is left of that, and the slope that a cell of the map holds: two uniform distributions.
  const double spread = (scene.cell * scene.cell + cell * cell) / 12;
  map.add(layer::variance, static_cast<float>(spread));
  return map;
}

template class SlideSeries<2>;
template class SlideSeries<3>;
template bool on_panel(const SlideScene&, const Point<2>&);
template bool on_panel(const SlideScene&, const Point<3>&);
template HeightMap pile_map(const SlideScene&, const std::vector<MaterialPoint<2>>&, double);
template HeightMap pile_map(const SlideScene&, const std::vector<MaterialPoint<3>>&, double);

}  // namespace aeolian
