#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/measure/photo.hpp"
#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

/// A straightedge over a bed, its light and its camera, to be photographed by ray casting.
///
/// Level frame: z up, x horizontal along the straightedge, y horizontal across it; its origin is the casting
/// edge at scale zero. The straightedge's own frame (see PhotoSetup) has the same origin and y axis and is
/// turned about y so that x rises by `inclination`.
struct ShadowScene {
  /// Height of the smooth bed in the level frame [m]; the truth that a profile is scored against.
  std::function<double(double x, double y)> bed;

  // straightedge
  double inclination = 0;          ///< [rad]
  int shadow_side = 1;             ///< +1: the shadow falls towards y > 0, the top face lies at y < 0
  double width = 0.03;             ///< of the top face [m]
  double thickness = 0.003;        ///< [m]
  double from = -0.25, to = 0.25;  ///< its ends along x [m]
  std::optional<PhotoSetup::Markers>
      markers;                         ///< printed on the top face; positions in the straightedge frame
  std::vector<Eigen::Vector2d> ticks;  ///< scale marks on the top face: small black dots, 0.5 mm [m]
  std::optional<double> post_height;   ///< a thin post (1.5 mm) on the casting edge [m] ...
  double post_x = 0;                   ///< ... there [m]

  // light
  double elevation = 0.6;        ///< [rad]
  double azimuth = 0;            ///< as PhotoSetup::Angles [rad]
  double sun_diameter = 0.0093;  ///< [rad]; the source is a uniform disc
  double skylight = 0.15;        ///< irradiance in the shadow over that in the sun on level ground
  double uneven_light = 0.1;     ///< relative change of the irradiance over the frame, in a random direction
  std::optional<double> second_light_azimuth;  ///< a second source of equal strength: two shadows

  // bed surface
  double grain_diameter = 0.00027;  ///< [m]
  double albedo = 0.35;
  double albedo_contrast = 0.2;  ///< relative standard deviation from grain to grain
  double roughness = 0.25;       ///< rms height of the grains about the bed, in grain diameters

  // camera
  CameraModel camera;
  Eigen::Isometry3d level_to_camera = Eigen::Isometry3d::Identity();
  double blur_px = 0.6;         ///< standard deviation of the lens' and sensor's point spread at the centre
  double blur_border_px = 1.0;  ///< the same at the corners
  double vignetting = 0.3;      ///< loss of light in the corners
  double exposure = 0.8;        ///< linear value of a sunlit level bed in the middle; above 1 clips
  double noise = 0.01;          ///< standard deviation of a linear value of 1, falling with its root
  int jpeg_quality = 92;        ///< 0: no JPEG, the values as they are
  std::optional<double> exif_focal_px;  ///< handed on to the photo [px]
  std::uint64_t seed = 1;
};

/// What a camera would write: 8-bit sRGB values.
Photo photograph(const ShadowScene& scene);
/// The same, as a colour JPEG file.
void write_jpeg(const ShadowScene& scene, const std::string& path);

/// Where the rays past the casting edge meet the smooth bed: the point of the level frame whose coordinate
/// along the straightedge is x [m]. The centre of the source counts.
Eigen::Vector3d true_bed_point(const ShadowScene& scene, double x);

/// Where the centre of the source casts the tip of the post onto the smooth bed, in the level frame [m].
Eigen::Vector3d true_tip_shadow(const ShadowScene& scene);

/// Where a point of the level frame is seen [px].
Eigen::Vector2d true_pixel(const ShadowScene& scene, const Eigen::Vector3d& point);

/// A scene and the setup that a careful person would write for it.
struct SetUp {
  ShadowScene scene;
  PhotoSetup setup;
  std::string yaml;       ///< the same setup as a file's text
  double wavelength = 0;  ///< of the ripples along the straightedge, in the section that the shadow draws [m]
  double from = 0;        ///< the part of the straightedge along which its top face and the far border of
  double to = 0;          ///< its shadow are in the frame [m]
};

/// One of the random set-ups of the accuracy bars: elevation 15-55 degrees, azimuth +-25, camera tilt +-20
/// about both axes, straightedge inclined and the bed not parallel to it by up to 5 degrees, ripples 3-20 cm,
/// grains 0.15-1 mm, 4-24 px per mm, a straightedge 25-40 mm wide with markers or with two rows of marks
/// whose pixels are good to 0.1 px; light given as angles (good to 0.1 degrees), by a post (pixels good to
/// 0.3 px) or by the sun. `megapixels` of the photo.
SetUp random_set_up(std::uint64_t seed, double megapixels);

}  // namespace aeolian
