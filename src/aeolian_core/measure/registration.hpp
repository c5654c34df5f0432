#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Geometry>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

enum class RegistrationMethod {
  icp,  ///< iterative closest points, point to plane: the sharper one
  ndt   ///< normal distributions transform in voxels of ten cells
};

struct RegistrationParameters {
  RegistrationMethod method = RegistrationMethod::icp;
  double max_shift = 0.05;     ///< a refinement that moves a point of the cloud farther is refused [m]
  double max_angle = 0.035;    ///< ... or that turns it by more [rad]
  double max_distance = 0.05;  ///< points farther from the map's surface have no part in it [m]
  /// A direction in which the surface rises and falls by less than this rms slope does not hold the cloud: a
  /// smooth error of the sensor's of a tenth of a millimetre would move it by several.
  double least_slope = 0.03;
  std::size_t min_pairs = 500;     ///< fewer points over the known map are refused
  std::size_t max_points = 20000;  ///< of the cloud that are used, drawn evenly along it
  int max_iterations = 100;        ///< of which few are needed but at edges
};

/// How a cloud was moved onto a map, or why not.
struct Registration {
  Eigen::Isometry3d pose;      ///< sensor to map: refined, or as given when not accepted
  double shift = 0;            ///< the farthest that the refinement moves a point of the cloud [m]
  double angle = 0;            ///< by which it turns the cloud [rad]
  double given_residual = 0;   ///< median distance of points from the map's surface as given [m]
  double median_residual = 0;  ///< the same after the refinement, accepted or not [m]
  std::size_t pairs = 0;       ///< points of the cloud that were used and lie over the known map
  int held = 0;                ///< degrees of freedom, of 6, that the surface holds and that were refined
  bool accepted = false;
  std::string reason;  ///< one line when not accepted
};

/// Refines the pose (sensor to map) of a cloud that overlaps a map, so that the cloud lies on the map's
/// elevation. On a level bed it is lifted and tilted only; on parallel ripples it is also moved across them
/// and turned; along them it stays as given (HeldDirections). Points off the surface (grains in flight,
/// flying pixels) are outweighed up to about a third of all. Distances are taken along the normals of the
/// surface (MapSurface), with the points that fall over the same cells; so the misalignment must be smaller
/// than a quarter of the ripples' length.
///
/// The result depends on the inputs alone. Not accepted: too few points over the map, a move beyond the
/// bounds, a median distance that grows, points that leave the map, steps that after max_iterations are still
/// larger than the standard error of the pose. Throws Error for parameters that cannot be, a pose that is not
/// finite, coordinates of different counts and a map without elevation.
Registration register_cloud(const PointCloud& cloud, const Eigen::Isometry3d& pose, const HeightMap& map,
                            const RegistrationParameters& parameters);

}  // namespace aeolian
