#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/measure/fusion.hpp"

namespace aeolian {

/// A sensor at some height that looks straight down (its z axis points to the ground).
inline Eigen::Isometry3d looking_down(double x, double y, double z) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return pose;
}

/// Points of the map frame as the sensor sees them.
inline PointCloud seen_from(const Eigen::Isometry3d& pose, const std::vector<Eigen::Vector3d>& points) {
  PointCloud cloud;
  for (const auto& p : points) {
    const Eigen::Vector3f q = (pose.inverse() * p).cast<float>();
    cloud.push_back(q.x(), q.y(), q.z());
  }
  return cloud;
}

/// The centre of every cell at one height.
inline std::vector<Eigen::Vector3d> level_points(const GridGeometry& g, double height) {
  std::vector<Eigen::Vector3d> points;
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 0; ix < g.nx(); ++ix) points.emplace_back(g.x(ix), g.y(iy), height);
  return points;
}

/// A cloud of one point that falls into the middle of the only cell of a 1 x 1 map of 1 cm at height z.
struct OneCell {
  GridGeometry geometry{0, 0, 0.01, 1, 1};
  Eigen::Isometry3d pose = looking_down(0.005, 0.005, 2);
  PointCloud at(double z) const { return seen_from(pose, {{0.005, 0.005, z}}); }
};

}  // namespace aeolian
