#include "aeolian_core/measure/camera_model.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d derivative;
};

/// Normalised coordinates behind the lens, and their derivative by those before it.
Distorted distort(const std::array<double, 8>& d, const Eigen::Vector2d& p) {
  const auto [k1, k2, p1, p2, k3, k4, k5, k6] = d;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double above = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double below = 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double radial = above / below;
  const double radial_slope =
      (k1 + r2 * (2 * k2 + r2 * 3 * k3) - radial * (k4 + r2 * (2 * k5 + r2 * 3 * k6))) / below;  // by r^2
  Distorted result;
  result.point = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                  y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  const double cross = 2 * x * y * radial_slope + 2 * p1 * x + 2 * p2 * y;
  result.derivative << radial + 2 * x * x * radial_slope + 2 * p1 * y + 6 * p2 * x, cross,  //
      cross, radial + 2 * y * y * radial_slope + 6 * p1 * y + 2 * p2 * x;
  return result;
}

}  // namespace

Eigen::Vector2d CameraModel::pixel(const Eigen::Vector3d& point) const {
  const Distorted seen = distort(distortion, point.head<2>() / point.z());
  if (!(seen.derivative.determinant() > 0))
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {fx * seen.point.x() + cx, fy * seen.point.y() + cy};
}

Eigen::Vector3d CameraModel::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  const double enough = 1e-10 / fx;
  Eigen::Vector2d p = seen;
  for (int i = 0; i < 50; ++i) {
    const Distorted at = distort(distortion, p);
    const Eigen::Vector2d miss = seen - at.point;
    if (miss.cwiseAbs().maxCoeff() <= enough && at.derivative.determinant() > 0) return {p.x(), p.y(), 1};
    // A step of a quarter of the field at most keeps Newton on the branch that holds the centre.
    Eigen::Vector2d step = at.derivative.inverse() * miss;
    const double length = step.norm();
    if (!(length < 1e3)) break;
    if (length > 0.25) step *= 0.25 / length;
    p += step;
  }
  throw Error(
      fmt::format("the lens distortion cannot be undone at pixel ({:.1f}, {:.1f})", pixel.x(), pixel.y()));
}

}  // namespace aeolian
