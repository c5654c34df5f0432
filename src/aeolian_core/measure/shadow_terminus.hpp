#pragma once

#include <vector>

#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/shadow_search.hpp"
#include "aeolian_core/measure/tone.hpp"

namespace aeolian {

/// Where the shadow ends, station by station, to a fraction of a pixel.
struct Terminus {
  struct Station {
    Eigen::Vector2d pixel;  ///< of half light
    Eigen::Vector2d lower;  ///< first light seen from the shadow, and last dark
    Eigen::Vector2d upper;
  };
  std::vector<Station> stations;  ///< in the order of x
  double pixel_size = 0;          ///< on the plane of the top face, across the edge [m]
  double width_px = 0;            ///< median standard deviation of the border's blur (lens, penumbra, grains)
};

/// Fits the border of the shadow at stations `spacing` [m] apart near its rough place. Each station is a
/// strip as wide as the spacing; across it the light rises as dark + (lit - dark) Phi((s - terminus) /
/// width), with the levels and the width taken from its surroundings. Half of the light is the ray past the
/// edge from the centre of the sun, whose penumbra is symmetric.
Terminus locate_terminus(const Tone& tone, const PhotoGeometry& geometry, const RoughTerminus& rough,
                         double spacing);

}  // namespace aeolian
