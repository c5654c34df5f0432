#include "aeolian_twin/nodes/slide_settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/slide/slide_config.hpp"

namespace aeolian {
namespace {

constexpr double level_within = 0.02;  ///< of the panel's y axis [rad]

SnowLaw read_snow(const Parameters& parameters) {
  SnowLaw snow;
  snow.density = parameters.number("snow_density");
  snow.youngs_modulus = parameters.number("snow_youngs_modulus");
  snow.poisson_ratio = parameters.number("snow_poisson_ratio");
  snow.friction = parameters.number("snow_m");
  snow.consolidation = parameters.number("snow_p0");
  snow.cohesion = parameters.number("snow_beta");
  snow.hardening = parameters.number("snow_xi");
  return snow;
}

SlideScene read_scene(const Parameters& parameters) {
  const std::string& file = parameters.text("scene_file");
  if (!file.empty()) return read_slide_config(file).scene;
  SlideScene scene;
  scene.snow = read_snow(parameters);
  scene.panel_length = parameters.number("panel_length");
  scene.panel_width = parameters.number("panel_width");
  scene.tilt = degrees_to_radians(parameters.number("panel_tilt_deg"));
  scene.panel_friction = parameters.number("panel_friction");
  scene.slab_width = parameters.number("slab_width");
  scene.slab_thickness = parameters.number("slab_thickness");
  scene.cell = parameters.number("cell");
  scene.particles_per_cell = parameters.number("particles_per_cell");
  return scene;
}

}  // namespace

std::vector<ParameterDeclaration> slide_parameters() {
  const SlideScene scene;
  const SnowLaw& snow = scene.snow;
  return {
      {"panel_frame", std::string(), "",
       "tf frame of the panel: origin in the middle of its surface, x down the slope, z out of it; empty: it "
       "stands where the next four say"},
      {"panel_x", 0.0, "m", "of the middle of the panel's surface, in frame_id", Limits::any()},
      {"panel_y", 0.0, "m", "the same", Limits::any()},
      {"panel_z", scene.panel_height, "m", "the same", Limits::any()},
      {"slide_direction_deg", 0.0, "degrees", "where snow slides to, counter-clockwise from east",
       Limits::any()},
      {"scene_file", std::string(), "",
       "file of config/slide with snow, panel, slab and grid; empty: as the parameters below say"},
      {"panel_tilt_deg", std::round(radians_to_degrees(scene.tilt)), "degrees", "below the horizontal",
       Limits::between(0, 90)},
      {"panel_length", scene.panel_length, "m", "along the slope, and that of the slab", Limits::positive()},
      {"panel_width", scene.panel_width, "m", "across", Limits::positive()},
      {"panel_friction", scene.panel_friction, "", "Coulomb's, between snow and panel",
       Limits::not_negative()},
      {"slab_width", scene.slab_width, "m", "of the snow on it", Limits::positive()},
      {"slab_thickness", scene.slab_thickness, "m", "normal to the panel, of events that release starts",
       Limits::positive()},
      {"snow_density", snow.density, "kg/m^3", "of fresh snow", Limits::positive()},
      {"snow_youngs_modulus", snow.youngs_modulus, "Pa", "E", Limits::positive()},
      {"snow_poisson_ratio", snow.poisson_ratio, "", "nu", Limits::between(0, 0.49)},
      {"snow_m", snow.friction, "", "M, slope of the critical state line", Limits::positive()},
      {"snow_p0", snow.consolidation, "Pa", "pre-consolidation pressure of fresh snow", Limits::positive()},
      {"snow_beta", snow.cohesion, "", "tensile strength over p0", Limits::not_negative()},
      {"snow_xi", snow.hardening, "", "hardening", Limits::positive()},
      {"cell", scene.cell, "m", "of the solver's grid; at most the thickness of a slab", Limits::positive()},
      {"particles_per_cell", scene.particles_per_cell, "", "6 or more in three dimensions",
       Limits::between(1, 1000)},
  };
}

PlacedSlide read_slide(const Parameters& parameters) {
  PlacedSlide slide{read_scene(parameters), {}};
  slide.scene.ground.reset();
  slide.scene.seed = static_cast<std::uint64_t>(parameters.integer("seed"));
  slide.scene.threads = parameters.integer("threads");
  slide.scene.height_of = SlideScene::HeightOf::centre;
  slide.scene.panel_height = parameters.number("panel_z");
  slide.site = {parameters.number("panel_x"), parameters.number("panel_y"),
                degrees_to_radians(parameters.number("slide_direction_deg"))};
  return slide;
}

void place_panel(PlacedSlide& slide, const Eigen::Isometry3d& pose, const std::string& frame) {
  const Eigen::Vector3d down = pose.linear().col(0), across = pose.linear().col(1);
  const double lean = std::asin(std::min(std::abs(across.z()), 1.0));
  if (lean > level_within)
    throw Error(fmt::format("the y axis of '{}' leans by {:.1f} degrees, must be level within {:.1f}", frame,
                            radians_to_degrees(lean), radians_to_degrees(level_within)));
  if (!(down.z() < 0) || !(pose.linear()(2, 2) > 0))
    throw Error(fmt::format("the x axis of '{}' rises by {:.1f} degrees, must go down the slope, and z up",
                            frame, radians_to_degrees(std::asin(std::clamp(down.z(), -1.0, 1.0)))));
  slide.scene.tilt = std::asin(std::min(-down.z(), 1.0));
  slide.scene.panel_height = pose.translation().z();
  slide.site = {pose.translation().x(), pose.translation().y(), std::atan2(down.y(), down.x())};
}

}  // namespace aeolian
