#pragma once

#include <vector>

#include "aeolian_core/measure/local_quadratic.hpp"
#include "aeolian_core/measure/photo_light.hpp"
#include "aeolian_core/measure/setup_geometry.hpp"

namespace aeolian {

/// Terminus pixels as points of the bed: reading along the straightedge, across it, and level height under
/// the casting edge at x = 0 [m].
struct Section {
  std::vector<double> x, y, z;
};

Section section_of(const std::vector<Eigen::Vector2d>& pixels, const PhotoGeometry& geometry,
                   const Light& light);

/// Standard errors of the smoothed heights that come from the stations' own scatter (grains, texture,
/// pixels) [m]. Neighbours are alike, since they share grains and blur: their covariance up to four stations
/// apart is solved from that of the residuals, which the regression has changed in a known way.
std::vector<double> scatter_sigma(const std::vector<double>& z, const LocalQuadratic& smooth,
                                  double half_width, double spacing);

/// What is common to a whole profile.
struct SharedError {
  std::vector<double> sigma;  ///< standard error at each pixel [m]
  double elevation = 0;       ///< of the light [rad]
  double azimuth = 0;         ///< [rad]
};

/// Propagates what the setup leaves open (pose, focal length, scale, light) to the heights, by moving each
/// part by one standard error; at fixed x, with `slope` the bed's; `zero_mean` when a shift of the whole does
/// not count.
SharedError shared_error(const PhotoSetup& setup, const SetupGeometry& frame, const PhotoLight& source,
                         const Light& light, const std::vector<Eigen::Vector2d>& pixels,
                         const std::vector<double>& slope, bool zero_mean);

}  // namespace aeolian
