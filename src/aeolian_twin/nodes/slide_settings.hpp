#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/slide/piles/slide_site.hpp"
#include "aeolian_twin/nodes/parameters.hpp"

namespace aeolian {

/// The parameters that tell snow, panel and where the panel stands.
std::vector<ParameterDeclaration> slide_parameters();

/// A scene and where it is in the map.
struct PlacedSlide {
  SlideScene scene;  ///< heights are those of the map
  SlideSite site;
};

/// As the parameters say; snow, panel and grid from `~scene_file` when it names one. Throws Error for a file
/// that cannot be read or used.
PlacedSlide read_slide(const Parameters& parameters);

/// Places the panel by a pose in the map: origin in the middle of its surface, x down the slope, z out of it.
/// Throws Error naming `frame` for a pose whose y axis is not level, or whose x axis does not go down.
void place_panel(PlacedSlide& slide, const Eigen::Isometry3d& pose, const std::string& frame);

}  // namespace aeolian
