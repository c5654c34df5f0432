#include "aeolian_core/measure/photo_geometry.hpp"

#include <cmath>
#include <limits>

namespace aeolian {
namespace {

constexpr double least_angle_sine = 0.2;  // of a ray to the plane of light (Werner spec: reject |n.r| < 0.2)
constexpr double tiny = 1e-5;             // over which the photo is straight [m]
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Eigen::Vector3d Light::direction() const {
  return {std::cos(elevation) * std::sin(azimuth), side * std::cos(elevation) * std::cos(azimuth),
          -std::sin(elevation)};
}

Eigen::Vector3d PhotoGeometry::edge() const { return {std::cos(inclination_), 0, std::sin(inclination_)}; }

double PhotoGeometry::pixels_along(double x) const {
  return (pixel(x + tiny, 0) - pixel(x - tiny, 0)).norm() / (2 * tiny);
}

double PhotoGeometry::pixels_across(double x) const {
  return (pixel(x, tiny) - pixel(x, -tiny)).norm() / (2 * tiny);
}

FullGeometry::FullGeometry(CameraPose pose, double inclination)
    : PhotoGeometry(inclination), pose_(std::move(pose)) {
  // The straightedge frame turned about y so that its x axis rises.
  const Eigen::Matrix3d to_level =
      Eigen::AngleAxisd(-inclination, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Isometry3d to_straightedge = pose_.to_camera.inverse();
  camera_to_level_ = to_level * to_straightedge.linear();
  centre_ = to_level * to_straightedge.translation();
}

Eigen::Vector2d FullGeometry::pixel(double x, double y) const {
  const Eigen::Vector3d point = pose_.to_camera * Eigen::Vector3d(x, y, 0);
  if (!(point.z() > 0)) return {nan, nan};
  return pose_.camera.pixel(point);
}

Eigen::Vector3d FullGeometry::ray(const Eigen::Vector2d& pixel) const {
  return (camera_to_level_ * pose_.camera.ray(pixel)).normalized();
}

Eigen::Vector2d FullGeometry::top_face(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector3d normal(-std::sin(inclination()), 0, std::cos(inclination()));
  const Eigen::Vector3d direction = ray(pixel);
  const Eigen::Vector3d point = centre_ - normal.dot(centre_) / normal.dot(direction) * direction;
  return {point.dot(edge()), point.y()};
}

Eigen::Vector3d FullGeometry::at_level(const Eigen::Vector2d& pixel, double z) const {
  const Eigen::Vector3d direction = ray(pixel);
  return centre_ + (z - centre_.z()) / direction.z() * direction;
}

Eigen::Vector3d FullGeometry::bed_point(const Eigen::Vector2d& pixel, const Light& light) const {
  const Eigen::Vector3d normal = edge().cross(light.direction()).normalized();
  const Eigen::Vector3d direction = ray(pixel);
  const double sine = normal.dot(direction);
  if (!(std::abs(sine) >= least_angle_sine)) return {nan, nan, nan};
  return centre_ - normal.dot(centre_) / sine * direction;
}

OverheadGeometry::OverheadGeometry(const Eigen::Vector2d& origin, const Eigen::Vector2d& along, double scale,
                                   double inclination)
    : PhotoGeometry(inclination),
      origin_(origin),
      along_(along),
      across_(along.y(), -along.x()),  // y is to the left of x seen from above, and rows run downwards
      scale_(scale) {}

Eigen::Vector2d OverheadGeometry::pixel(double x, double y) const {
  return origin_ + scale_ * (x * along_ + y * across_);
}

Eigen::Vector2d OverheadGeometry::top_face(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d from = (pixel - origin_) / scale_;
  return {from.dot(along_), from.dot(across_)};
}

Eigen::Vector3d OverheadGeometry::at_level(const Eigen::Vector2d& pixel, double z) const {
  const Eigen::Vector2d plan = top_face(pixel);
  return {plan.x(), plan.y(), z};
}

Eigen::Vector3d OverheadGeometry::bed_point(const Eigen::Vector2d& pixel, const Light& light) const {
  const Eigen::Vector2d plan = top_face(pixel);
  const double displacement = light.side * plan.y();
  const double rise = std::tan(inclination());
  return {plan.x(), plan.y(),
          plan.x() * rise - displacement * (std::tan(light.elevation) / std::cos(light.azimuth) +
                                            rise * std::tan(light.azimuth))};
}

}  // namespace aeolian
