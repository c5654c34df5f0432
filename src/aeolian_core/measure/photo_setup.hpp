#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/measure/camera_model.hpp"

namespace aeolian {

/// What is known of a photograph of a straightedge's shadow: the content of a setup file, in metres and
/// radians.
///
/// Straightedge frame: x along the scale, y square to it on the top face with y = 0 on the casting edge, z
/// up, right-handed. The casting edge is the upper edge on the shadow's side, which may be either.
struct PhotoSetup {
  struct ScaleMark {
    Eigen::Vector2d pixel;
    double x = 0;             ///< [m]
    std::optional<double> y;  ///< [m]
  };
  struct Markers {
    struct Centre {
      int id = 0;
      Eigen::Vector2d position;  ///< x, y [m]
    };
    std::string dictionary;  ///< of OpenCV: DICT_4X4_50 ... DICT_APRILTAG_36h11
    double size = 0;         ///< side of the black square [m]
    std::vector<Centre> centres;
  };
  struct Angles {
    double elevation = 0;  ///< of the source over the horizon [rad]
    double azimuth = 0;  ///< of the light's travel from the edge's normal towards the shadow, towards larger
                         ///< x positive [rad]
  };
  struct Post {
    double height = 0;  ///< over the casting edge, on which it stands square to the top face [m]
    Eigen::Vector2d base_px;
    Eigen::Vector2d tip_px;  ///< of the tip's shadow on the bed
  };
  struct Sun {
    double unix_time = 0;      ///< [s, UTC]
    double latitude = 0;       ///< [rad]
    double longitude = 0;      ///< [rad]
    Eigen::Vector2d north_px;  ///< true north on the photo
  };

  std::optional<CameraModel> camera;
  bool plumb = false;                    ///< the camera looks straight down
  std::vector<Eigen::Vector2d> line_px;  ///< points on the casting edge
  std::vector<ScaleMark> scale;
  std::optional<Markers> markers;
  int shadow_side = 0;           ///< the shadow falls towards y > 0 (+1) or y < 0 (-1); 0: as the marks tell
  double inclination = 0;        ///< of the straightedge, rise towards larger x [rad]
  std::optional<double> height;  ///< of the casting edge at x = 0 over the bed's mean plane [m]
  std::variant<std::monostate, Angles, Post, Sun> light;
  std::optional<double> grain_diameter;    ///< [m]
  std::optional<Eigen::Vector2d> wind_px;  ///< the way the wind blows, on the photo
};

/// Reads a setup file (YAML, lengths in millimetres, angles in degrees; keys as in docs/measure_photo.md) or
/// throws Error naming file, line, key, value and what is allowed: unknown keys, wrong types, angles that
/// cannot be (light above 85 or below 3 degrees), no scale or no light in any form, scale marks that
/// contradict one another by themselves (two x for one pixel, two pixels for one mark, x not monotonic along
/// a single row).
/// With the pose of the camera known from elsewhere there need be no scale: `scale_needed` false.
PhotoSetup read_photo_setup(const std::string& path, bool scale_needed = true);

}  // namespace aeolian
