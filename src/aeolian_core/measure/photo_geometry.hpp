#pragma once

#include <memory>

#include <Eigen/Geometry>

#include "aeolian_core/measure/plane_pose.hpp"

namespace aeolian {

/// The way light travels past the casting edge.
struct Light {
  double elevation = 0;  ///< [rad]
  double azimuth = 0;    ///< from the edge's normal towards the shadow, towards larger x positive [rad]
  int side = 1;          ///< the shadow falls towards y > 0 (+1) or y < 0 (-1)

  /// Unit vector in the level frame.
  Eigen::Vector3d direction() const;
};

/// How pixels and the world belong together.
///
/// Level frame: z up, x horizontal along the straightedge, y horizontal across it, origin on the casting edge
/// at scale zero. The straightedge frame is this one turned about y by the inclination.
class PhotoGeometry {
 public:
  explicit PhotoGeometry(double inclination) : inclination_(inclination) {}
  virtual ~PhotoGeometry() = default;

  double inclination() const { return inclination_; }
  /// The casting edge's direction in the level frame.
  Eigen::Vector3d edge() const;
  /// Where a point of the plane of the top face is seen [px]; NaN where it is not.
  virtual Eigen::Vector2d pixel(double x, double y) const = 0;
  /// Pixels per metre of that plane about a place of the casting edge, along and across the edge.
  double pixels_along(double x) const;
  double pixels_across(double x) const;
  /// The point of the plane of the top face that a pixel shows: x, y [m].
  virtual Eigen::Vector2d top_face(const Eigen::Vector2d& pixel) const = 0;
  /// The point of the level frame at height z that a pixel shows [m].
  virtual Eigen::Vector3d at_level(const Eigen::Vector2d& pixel, double z) const = 0;
  /// The point of the bed, in the level frame, whose pixel the edge's shadow ends in [m]: where the camera's
  /// ray meets the plane of light through the casting edge. NaN where the two are nearly parallel.
  virtual Eigen::Vector3d bed_point(const Eigen::Vector2d& pixel, const Light& light) const = 0;
  /// The coordinate along the straightedge of a point of the bed [m].
  virtual double reading(const Eigen::Vector3d& bed_point) const { return bed_point.dot(edge()); }

 private:
  double inclination_;
};

/// A camera in a known place.
class FullGeometry : public PhotoGeometry {
 public:
  FullGeometry(CameraPose pose, double inclination);

  Eigen::Vector2d pixel(double x, double y) const override;
  Eigen::Vector2d top_face(const Eigen::Vector2d& pixel) const override;
  Eigen::Vector3d at_level(const Eigen::Vector2d& pixel, double z) const override;
  Eigen::Vector3d bed_point(const Eigen::Vector2d& pixel, const Light& light) const override;

 private:
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  CameraPose pose_;
  Eigen::Matrix3d camera_to_level_;
  Eigen::Vector3d centre_;  ///< of the camera, level frame [m]
};

/// The classic approximation (Werner 1987, ch. V): the photo is a plan of one scale, heights do not shift
/// what is seen, and a height is the displacement of the shadow times the tangent of the light's elevation.
class OverheadGeometry : public PhotoGeometry {
 public:
  /// `origin` is the pixel of scale zero on the casting edge, `along` a unit vector on the photo towards
  /// larger x, `scale` in pixels per metre.
  OverheadGeometry(const Eigen::Vector2d& origin, const Eigen::Vector2d& along, double scale,
                   double inclination);

  Eigen::Vector2d pixel(double x, double y) const override;
  Eigen::Vector2d top_face(const Eigen::Vector2d& pixel) const override;
  Eigen::Vector3d at_level(const Eigen::Vector2d& pixel, double z) const override;
  Eigen::Vector3d bed_point(const Eigen::Vector2d& pixel, const Light& light) const override;
  double reading(const Eigen::Vector3d& bed_point) const override { return bed_point.x(); }

 private:
  Eigen::Vector2d origin_;
  Eigen::Vector2d along_;
  Eigen::Vector2d across_;
  double scale_;
};

}  // namespace aeolian
