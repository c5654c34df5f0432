#pragma once

#include <vector>

#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

/// What a photo tells of the light's direction.
struct PhotoLight {
  int side = 1;                           ///< of the shadow
  Eigen::Vector2d middle_px;              ///< of the photo, where north is drawn
  std::vector<Eigen::Vector2d> terminus;  ///< where the shadow ends, in the order of x
};

/// How far what is given of the light may be off, and by how much it is taken to be off here: zero for the
/// best estimate.
struct LightDoubt {
  double elevation = 0;  ///< [rad]
  double azimuth = 0;    ///< [rad]
  Eigen::Vector2d base_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d tip_px = Eigen::Vector2d::Zero();
  double tip_height = 0;  ///< of the bed at the shadow of a post's tip [m]
};

/// The direction of light of a photo.
///
/// A post's shadow tip lies on the bed, whose height there is taken from the shadow's own end at the same x
/// (Werner's assumption that the bed does not change along the crests over the length of a shadow): the
/// direction and that height are found together. Throws Error when the sun was down or on the other side,
/// when the light is above 85 or below 3 degrees, and when a post's tip does not lie in its light.
Light find_light(const PhotoSetup& setup, const PhotoGeometry& geometry, const PhotoLight& source,
                 const LightDoubt& doubt = {});

/// What is to be doubted of a setup's light, each by one standard error: given angles are good to 0.1
/// degrees, the sun's elevation to 0.02 and a drawn north to 0.5 degrees, a post's pixels to 0.3 px, and the
/// bed under its tip's shadow to what the section varies within 10 degrees of straight across, at least 1 %
/// of the way.
std::vector<LightDoubt> light_doubts(const PhotoSetup& setup, const PhotoGeometry& geometry,
                                     const PhotoLight& source, const Light& light);

}  // namespace aeolian
