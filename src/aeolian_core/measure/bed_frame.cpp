#include "aeolian_core/measure/bed_frame.hpp"

#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/lmeds.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include "aeolian_core/measure/biweights.hpp"
#include "aeolian_core/measure/cloud_sample.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/quiet_pcl.hpp"

namespace aeolian {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr std::size_t most_points = 20000;
constexpr std::size_t fewest_points = 10;
constexpr double steepest = 80 * M_PI / 180;
/// Planes through three points that are tried. At a third of outliers, a third of them have none.
constexpr int trials = 200;
/// Points narrower than this part of their length are a line.
constexpr double narrowest = 1e-3;

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

Plane most_common_plane(const Points& points) {
  using Point = pcl::PointXYZ;
  auto cloud = std::make_shared<pcl::PointCloud<Point>>();
  for (const Eigen::Vector3d& p : points)
    cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  pcl::Indices all(points.size());
  std::iota(all.begin(), all.end(), 0);
  const auto model = std::make_shared<pcl::SampleConsensusModelPlane<Point>>(cloud, all, false);
  constexpr double any = 1;  // PCL wants a threshold, for a list of inliers that is not used here
  pcl::LeastMedianSquares<Point> search(model, any);
  search.setMaxIterations(trials);
  Eigen::VectorXf plane;
  const QuietPcl quiet;
  if (search.computeModel()) search.getModelCoefficients(plane);
  if (plane.size() != 4 || !plane.allFinite())
    throw Error("bed frame: the points of the cloud lie on a line, must be spread over the bed");
  const Eigen::Vector3d normal = plane.head<3>().cast<double>();
  return {normal, -static_cast<double>(plane[3]) * normal};
}

/// Least squares with the points weighed by their distance from the plane so far.
Plane refined(const Points& points, const Plane& before) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector3d& point : points) distances.push_back(before.normal.dot(point - before.middle));
  const std::vector<double> weights = biweights(std::move(distances));
  Plane plane{{0, 0, 0}, {0, 0, 0}};
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    plane.middle += weights[i] * points[i];
    total += weights[i];
  }
  plane.middle /= total;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    spread += weights[i] * (points[i] - plane.middle) * (points[i] - plane.middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  if (!(solver.eigenvalues()[1] > narrowest * narrowest * solver.eigenvalues()[2]))
    throw Error("bed frame: the points of the cloud lie on a line, must be spread over the bed");
  plane.normal = solver.eigenvectors().col(0);
  return plane;
}

}  // namespace

Eigen::Isometry3d fit_bed_frame(const PointCloud& cloud, const Eigen::Isometry3d& sensor_to_map) {
  Points points =
      sample_of(cloud, sensor_to_map, most_points, "bed frame", [](const Eigen::Vector3d&) { return true; });
  if (points.size() < fewest_points)
    throw Error(fmt::format("bed frame: the cloud has {} finite points, at least {} are needed",
                            points.size(), fewest_points));
  const Eigen::Vector3d origin = centred(points);
  Plane plane = most_common_plane(points);
  constexpr int most_refinements = 50;
  constexpr double still = 1e-9;
  for (int i = 0; i < most_refinements; ++i) {
    const Plane next = refined(points, plane);
    const bool settled = next.normal.cross(plane.normal).norm() < still;
    plane = next;
    if (settled) break;
  }
  if (plane.normal.z() < 0) plane.normal = -plane.normal;
  const double slope = std::acos(std::min(plane.normal.z(), 1.0));
  if (slope > steepest)
    throw Error(
        fmt::format("bed frame: the plane of the cloud is inclined by {:.1f} deg, must be at most {:g} deg",
                    slope * 180 / M_PI, steepest * 180 / M_PI));
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d across = plane.normal.cross(Eigen::Vector3d::UnitX()).normalized();
  frame.linear().col(0) = across.cross(plane.normal);
  frame.linear().col(1) = across;
  frame.linear().col(2) = plane.normal;
  frame.translation() = origin + plane.middle;
  return frame;
}

}  // namespace aeolian
