#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/measure/photo.hpp"
#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

enum class ProfileMode {
  full,      ///< camera ray against the plane of light: perspective, lens, tilt
  overhead,  ///< the classic approximation: displacement of the shadow times the tangent (Werner 1987, ch. V)
};

/// A figure with its standard error, in the same unit.
struct Figure {
  double value = 0;
  double sigma = 0;
};

/// A cross-section of the bed measured on one photograph, at stations one grain (at least a pixel) apart
/// along the straightedge. Stations where the shadow could not be found are left out: gaps are gaps in x.
struct ShadowProfile {
  std::vector<double> x;  ///< of the bed point along the straightedge, rising [m]
  std::vector<double> z;  ///< up; over the bed's mean plane when the height is known, else zero mean [m]
  std::vector<double> sigma_z;  ///< standard error of z [m]
  std::vector<double> y;        ///< of the bed point across the straightedge, 0 under the casting edge [m]
  std::vector<Eigen::Vector2d> terminus_px;  ///< where the shadow ends on the photo
  std::vector<double>
      spread;  ///< upper minus lower extreme of the terminus (lit tips, dark hollows), as height [m]

  ProfileMode mode = ProfileMode::full;
  Figure elevation;                       ///< of the light [rad]
  Figure azimuth;                         ///< [rad], see PhotoSetup::Angles
  Figure scale;                           ///< pixels per metre on the top face, at the middle of the profile
  double inclination = 0;                 ///< of the straightedge [rad]
  double drop = 0;                        ///< mean depth of the bed under the casting edge [m]
  double grain_diameter = 0;              ///< given, or 0 [m]
  std::optional<double> pose_rms_px;      ///< of the marks about the pose found
  std::optional<double> camera_distance;  ///< from the middle of the edge [m]
  std::optional<double>
      downwind;               ///< +1 when the wind blows to larger x, -1 to smaller, absent when not known
  double relative_sigma = 0;  ///< standard error that all heights share as a factor (light's angle, scale)

  std::vector<Eigen::Vector2d> edge_px;  ///< the casting edge on the photo, as a line of points
  std::vector<Eigen::Vector2d> band_px;  ///< outline of what was searched
  std::vector<Eigen::Vector2d> mark_px;  ///< the marks and marker corners used
  std::vector<std::string> remarks;      ///< what a person should know, one line each
};

/// Measures the bed's cross-section on a photograph. Throws Error saying why in one line when the photo
/// cannot be measured: no shadow, more than one, over-exposed, blurred, the edge outside the frame, sizes of
/// photo and camera that differ, marks that disagree, a pose or focal length that the marks cannot fix.
///
///     const Photo photo = read_photo("kelso_03.jpg");
///     const ShadowProfile profile = measure_shadow(photo, read_photo_setup("setup.yaml"),
///     ProfileMode::full);
ShadowProfile measure_shadow(const Photo& photo, const PhotoSetup& setup, ProfileMode mode);

/// The same with the pose of the camera known (straightedge frame to camera frame), as from tf: needs
/// setup.camera, and no scale.
ShadowProfile measure_shadow(const Photo& photo, const PhotoSetup& setup,
                             const Eigen::Isometry3d& straightedge_to_camera);

}  // namespace aeolian
