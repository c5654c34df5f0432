#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Where a straightedge lies in a frame whose z is up (the map), for placing its profile there.
struct StraightedgePlace {
  Eigen::Isometry3d level_to_map;  ///< of the level frame: z up, x horizontal along the straightedge
  double inclination = 0;          ///< rise of the straightedge towards larger x [rad]
  double lean = 0;  ///< of the top face across, 0 when the straightedge's y axis is horizontal [rad]
};

/// The place of a straightedge whose frame (see PhotoSetup) has this pose. Throws Error for one that stands
/// steeper than 45 degrees.
StraightedgePlace straightedge_place(const Eigen::Isometry3d& straightedge_to_map);

/// The bed points of a profile in the level frame: z up, x horizontal along the straightedge, origin on the
/// casting edge at scale zero [m]. Throws Error for x, y and z of different counts.
std::vector<Eigen::Vector3d> bed_points(const ShadowProfile& profile);

/// A profile as measured cells of a map: the smallest grid of cells of side `cell` [m] that holds the bed
/// points, known only where the section runs. Layers: elevation [m], variance [m^2].
///
/// A cell has the height of the section beside its centre, for the bed is taken not to change across the
/// section over a cell's width. The variance is that of the profile there: neighbouring heights share their
/// errors, so that a cell with several is no better. Gaps wider than three usual steps between stations and
/// a cell stay unknown. Throws Error for fewer than two stations and as GridGeometry does.
HeightMap profile_strip(const ShadowProfile& profile, const Eigen::Isometry3d& level_to_map, double cell);

}  // namespace aeolian
