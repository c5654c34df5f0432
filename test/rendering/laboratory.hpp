#pragma once

#include <functional>

#include "shadow_scene.hpp"

namespace aeolian {

/// A rig in a laboratory, where all is known: a straightedge with two rows of marks, a calibrated pinhole
/// camera that looks at the middle of edge and shadow, light from an exact direction. Lengths in metres,
/// angles in radians; x runs along the frame's rows.
struct Laboratory {
  std::function<double(double x, double y)> bed;  ///< level frame, the casting edge is its origin
  double elevation = 0.7;
  double azimuth = 0;
  double inclination = 0;
  double camera_distance = 1;
  double off_nadir = 0;  ///< of the camera, leaning across and along the edge alike
  double pixels_per_metre = 1e4;
  int width_px = 1264;
  int height_px = 948;
  double grain_diameter = 0.272e-3;  ///< that of the thesis
  std::uint64_t seed = 1;
};

/// `wavelength` of the set-up is left at 0.
SetUp set_up_of(const Laboratory& laboratory);

}  // namespace aeolian
