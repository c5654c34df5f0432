#include "aeolian_core/slide/piles/slide_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aeolian_core/slide/mpm/snow_body.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr double gap_cells = 0.25;       ///< between panel and slab, where contact begins
constexpr double panel_least_cells = 4;  ///< thickness

double centre_height(const SlideScene& scene) {
  const double half_drop = 0.5 * scene.panel_length * std::sin(scene.tilt);
  return scene.height_of == SlideScene::HeightOf::centre ? scene.panel_height
                                                         : scene.panel_height + half_drop;
}

template <int Dim>
std::shared_ptr<const Shape<Dim>> ground_shape(const SlideScene& scene) {
  if (scene.ground) return std::make_shared<Terrain<Dim>>(*scene.ground);
  return std::make_shared<HalfSpace<Dim>>(Point<Dim>::Zero(), Point<Dim>::Unit(Dim - 1));
}

/// How far the panel's lower side is above the ground where it is nearest [m], cell by cell.
template <int Dim>
double clearance(const SlideScene& scene) {
  const PanelFrame<Dim> frame = panel_frame<Dim>(scene);
  const auto ground = ground_shape<Dim>(scene);
  const double half_length = 0.5 * scene.panel_length;
  const double half_width = Dim == 3 ? 0.5 * scene.panel_width : 0;
  const auto parts = [&](double half) { return std::max(1., std::ceil(2 * half / scene.cell)); };
  double least = std::numeric_limits<double>::infinity();
  for (double i = 0; i <= parts(half_length); ++i)
    for (double j = 0; j <= (Dim == 3 ? parts(half_width) : 0); ++j) {
      Point<Dim> local = Point<Dim>::Constant(-panel_thickness(scene));
      local[0] = half_length * (2 * i / parts(half_length) - 1);
      if constexpr (Dim == 3) local[1] = half_width * (2 * j / parts(half_width) - 1);
      const Nearness<Dim> near = ground->at(frame.centre + frame.axes * local);
      least = std::min(least, near.distance / near.normal[Dim - 1]);
    }
  return least;
}

}  // namespace

double SlideScene::lower_edge() const { return centre_height(*this) - 0.5 * panel_length * std::sin(tilt); }

double panel_thickness(const SlideScene& scene) { return panel_least_cells * scene.cell; }

PileRules SlideScene::rules() const {
  PileRules rules;
  rules.link = 2 * cell;
  return rules;
}

void check(const SlideScene& scene, int dimensions) {
  check(scene.snow);
  constexpr Require require{"slide"};
  constexpr double far = 1e4;
  require(scene.panel_length > 0 && scene.panel_length <= far, "panel length", scene.panel_length,
          "above 0 and at most 1e4 m");
  require(scene.tilt > 0 && scene.tilt < M_PI / 2, "tilt", scene.tilt * 180 / M_PI,
          "above 0 and below 90 degrees");
  require(scene.slab_thickness > 0 && scene.slab_thickness <= far, "thickness of the slab",
          scene.slab_thickness, "positive");
  require(scene.cell > 0 && scene.cell <= scene.slab_thickness, "cell", scene.cell,
          "above 0 and at most the thickness of the slab");
  require(scene.panel_friction >= 0 && scene.panel_friction <= 10, "friction of the panel",
          scene.panel_friction, "from 0 to 10");
  require(scene.jitter >= 0 && scene.jitter <= 0.5, "jitter", scene.jitter, "from 0 to 0.5");
  require(scene.particles_per_cell >= 1 && scene.particles_per_cell <= 1000, "particles per cell",
          scene.particles_per_cell, "from 1 to 1000");
  require(std::isfinite(scene.panel_height), "height of the panel", scene.panel_height, "finite");
  require(scene.still > 0, "speed of stillness", scene.still, "positive");
  require(scene.still_for >= 0, "time of stillness", scene.still_for, "at least 0 s");
  require(scene.longest > 0 && scene.longest <= 3600, "longest event", scene.longest,
          "above 0 and at most 3600 s");
  require(scene.stuck_after > 0, "time after which a slab is stuck", scene.stuck_after, "positive");
  if (dimensions == 3) {
    require(scene.slab_width > 0 && scene.slab_width <= far, "width of the slab", scene.slab_width,
            "positive");
    require(scene.panel_width >= scene.slab_width && scene.panel_width <= far, "width of the panel",
            scene.panel_width, "at least that of the slab");
  }
  const double clear = dimensions == 3 ? clearance<3>(scene) : clearance<2>(scene);
  require(clear > 0, "the lower side of the panel above the ground", clear,
          "positive: it is four cells thick, and must not be in the ground");
}

template <int Dim>
PanelFrame<Dim> panel_frame(const SlideScene& scene) {
  PanelFrame<Dim> frame;
  frame.centre = Point<Dim>::Zero();
  frame.centre[Dim - 1] = centre_height(scene);
  frame.axes.setZero();
  const double c = std::cos(scene.tilt), s = std::sin(scene.tilt);
  frame.axes(0, 0) = c;
  frame.axes(Dim - 1, 0) = -s;
  if constexpr (Dim == 3) frame.axes(1, 1) = 1;
  frame.axes(0, Dim - 1) = s;
  frame.axes(Dim - 1, Dim - 1) = c;
  return frame;
}

template <int Dim>
std::vector<Obstacle<Dim>> obstacles_of(const SlideScene& scene) {
  const PanelFrame<Dim> frame = panel_frame<Dim>(scene);
  Point<Dim> half;
  half[0] = 0.5 * scene.panel_length;
  if constexpr (Dim == 3) half[1] = 0.5 * scene.panel_width;
  half[Dim - 1] = 0.5 * panel_thickness(scene);
  const Point<Dim> middle = frame.centre - half[Dim - 1] * frame.axes.col(Dim - 1);
  return {{std::make_shared<Plate<Dim>>(middle, frame.axes, half), Contact::separate, scene.panel_friction,
           Point<Dim>::Zero()},
          {ground_shape<Dim>(scene), Contact::sticky, 0, Point<Dim>::Zero()}};
}

template <int Dim>
std::vector<MaterialPoint<Dim>> slab_of(const SlideScene& scene, int event) {
  const PanelFrame<Dim> frame = panel_frame<Dim>(scene);
  SnowBox<Dim> box;
  box.axes = frame.axes;
  box.size[0] = scene.panel_length;
  if constexpr (Dim == 3) box.size[1] = scene.slab_width;
  box.size[Dim - 1] = scene.slab_thickness;
  Point<Dim> local = -0.5 * box.size;
  local[Dim - 1] = gap_cells * scene.cell;
  box.corner = frame.centre + frame.axes * local;
  const std::uint64_t seed = scene.seed * 1000003 + static_cast<std::uint64_t>(event);
  return filled_box(box, scene.snow, scene.cell, scene.particles_per_cell, scene.jitter, seed);
}

#define AEOLIAN_FOR(Dim)                                               \
  template PanelFrame<Dim> panel_frame(const SlideScene&);             \
  template std::vector<Obstacle<Dim>> obstacles_of(const SlideScene&); \
  template std::vector<MaterialPoint<Dim>> slab_of(const SlideScene&, int);
AEOLIAN_FOR(2)
AEOLIAN_FOR(3)
#undef AEOLIAN_FOR

}  // namespace aeolian
