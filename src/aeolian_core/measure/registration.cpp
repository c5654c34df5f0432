#include "aeolian_core/measure/registration.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include "aeolian_core/measure/cloud_sample.hpp"
#include "aeolian_core/measure/map_surface.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/quiet_pcl.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Steps below this part of a cell end the iteration.
constexpr double step_per_cell = 5e-3;
/// Side of NDT's voxels, in cells of the map.
constexpr double cells_per_voxel = 10;

constexpr Require require{"registration"};

void check(const RegistrationParameters& p) {
  const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
  require(positive(p.max_shift), "max_shift", p.max_shift, "positive and finite");
  require(positive(p.max_angle), "max_angle", p.max_angle, "positive and finite");
  require(positive(p.max_distance), "max_distance", p.max_distance, "positive and finite");
  require(positive(p.least_slope), "least_slope", p.least_slope, "positive and finite");
  require(p.min_pairs >= 10, "min_pairs", static_cast<double>(p.min_pairs), "at least 10");
  require(p.max_points >= p.min_pairs, "max_points", static_cast<double>(p.max_points), "at least min_pairs");
  require(p.max_iterations >= 1, "max_iterations", p.max_iterations, "at least 1");
}

template <class Point>
typename pcl::PointCloud<Point>::Ptr to_pcl(const Points& points, double scale) {
  auto cloud = std::make_shared<pcl::PointCloud<Point>>();
  cloud->resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    (*cloud)[i].getVector3fMap() = (scale * points[i]).cast<float>();
  return cloud;
}

using PlanePoint = pcl::PointNormal;
using PlaneCloud = pcl::PointCloud<PlanePoint>;

/// Pairs each point with the surface under it. The target holds, for each point, where its plane is: it is
/// written anew for each pairing, so that planes are fitted only where points are.
class PointsOverSurface
    : public pcl::registration::CorrespondenceEstimationBase<PlanePoint, PlanePoint, double> {
 public:
  PointsOverSurface(MapSurface& surface, PlaneCloud::Ptr planes)
      : surface_(surface), planes_(std::move(planes)) {}

  void determineCorrespondences(pcl::Correspondences& pairs, double max_distance) override {
    pairs.clear();
    for (std::size_t i = 0; i < input_->size(); ++i) {
      const auto pair = surface_.under((*input_)[i].getVector3fMap().cast<double>());
      if (!pair || !(std::abs(pair->residual) <= max_distance)) continue;
      const Eigen::Vector3d foot = pair->point - pair->residual * pair->normal;
      (*planes_)[i].getVector3fMap() = foot.cast<float>();
      (*planes_)[i].getNormalVector3fMap() = pair->normal.cast<float>();
      const auto index = static_cast<pcl::index_t>(i);
      pairs.emplace_back(index, index, static_cast<float>(pair->residual * pair->residual));
    }
  }
  void determineReciprocalCorrespondences(pcl::Correspondences& pairs, double max_distance) override {
    determineCorrespondences(pairs, max_distance);
  }
  Ptr clone() const override { return std::make_shared<PointsOverSurface>(*this); }

 private:
  MapSurface& surface_;
  PlaneCloud::Ptr planes_;
};

/// The robust step within the held directions, as PCL's iteration asks for it.
class StepToPlanes : public pcl::registration::TransformationEstimation<PlanePoint, PlanePoint, double> {
 public:
  StepToPlanes(const HeldDirections& held, double farthest) : held_(held), farthest_(farthest) {}

  void estimateRigidTransformation(const PlaneCloud& cloud, const PlaneCloud& planes,
                                   const pcl::Correspondences& matches, Matrix4& step) const override {
    std::vector<PointOnPlane> pairs;
    pairs.reserve(matches.size());
    for (const pcl::Correspondence& match : matches) {
      const PlanePoint& plane = planes[static_cast<std::size_t>(match.index_match)];
      const Eigen::Vector3d point =
          cloud[static_cast<std::size_t>(match.index_query)].getVector3fMap().cast<double>();
      const Eigen::Vector3d normal = plane.getNormalVector3fMap().cast<double>();
      pairs.push_back({point, normal, normal.dot(point - plane.getVector3fMap().cast<double>()), 0});
    }
    step = step_to_planes(pairs, farthest_, held_).matrix();
  }
  void estimateRigidTransformation(const PlaneCloud& cloud, const PlaneCloud& planes,
                                   Matrix4& step) const override {
    pcl::Correspondences all;
    for (std::size_t i = 0; i < std::min(cloud.size(), planes.size()); ++i)
      all.emplace_back(static_cast<pcl::index_t>(i), static_cast<pcl::index_t>(i), 0.F);
    estimateRigidTransformation(cloud, planes, all, step);
  }
  void estimateRigidTransformation(const PlaneCloud& cloud, const pcl::Indices& of_cloud,
                                   const PlaneCloud& planes, Matrix4& step) const override {
    estimateRigidTransformation(PlaneCloud(cloud, of_cloud), planes, step);
  }
  void estimateRigidTransformation(const PlaneCloud& cloud, const pcl::Indices& of_cloud,
                                   const PlaneCloud& planes, const pcl::Indices& of_planes,
                                   Matrix4& step) const override {
    estimateRigidTransformation(PlaneCloud(cloud, of_cloud), PlaneCloud(planes, of_planes), step);
  }

 private:
  HeldDirections held_;
  double farthest_;
};

double median_distance(const std::vector<PointOnPlane>& pairs) {
  std::vector<double> distances;
  distances.reserve(pairs.size());
  for (const PointOnPlane& pair : pairs) distances.push_back(std::abs(pair.residual));
  return median(std::move(distances));
}

Points moved_points(const Eigen::Isometry3d& move, Points points) {
  for (Eigen::Vector3d& point : points) point = move * point;
  return points;
}

/// Whether a step is smaller than the standard error of the pose: at edges, where planes come and go, the
/// iteration may go around in so small a circle for ever.
bool within_error(const Eigen::Isometry3d& step, const std::vector<PointOnPlane>& pairs,
                  const HeldDirections& held) {
  double squares = 0;
  for (const PointOnPlane& pair : pairs)
    squares += std::pow(pair.normal.dot(step * pair.point - pair.point), 2);
  const double sigma = sigma_per_median * median_distance(pairs);
  return squares <= sigma * sigma * static_cast<double>(held.basis.cols());
}

/// Nothing when it does not come to an end. Moves are of points about the local origin.
std::optional<Eigen::Isometry3d> move_by_icp(const Points& points, MapSurface& surface,
                                             const HeldDirections& held, const RegistrationParameters& p) {
  const double step = step_per_cell * surface.cell();
  const double turn = step / held.arm;
  auto planes = std::make_shared<PlaneCloud>();
  planes->resize(points.size());
  pcl::IterativeClosestPoint<PlanePoint, PlanePoint, double> icp;
  icp.setInputSource(to_pcl<PlanePoint>(points, 1));
  icp.setInputTarget(planes);
  icp.setSearchMethodTarget(std::make_shared<pcl::search::KdTree<PlanePoint>>(), true);
  icp.setCorrespondenceEstimation(std::make_shared<PointsOverSurface>(surface, planes));
  icp.setTransformationEstimation(std::make_shared<StepToPlanes>(held, p.max_distance));
  icp.setMaxCorrespondenceDistance(p.max_distance);
  icp.setMaximumIterations(p.max_iterations);
  icp.setTransformationEpsilon(step * step);
  icp.setTransformationRotationEpsilon(1 - turn * turn / 2);
  icp.getConvergeCriteria()->setAbsoluteMSE(0);
  icp.getConvergeCriteria()->setFailureAfterMaximumIterations(true);
  PlaneCloud moved;
  icp.align(moved);
  const Eigen::Isometry3d move(icp.getFinalTransformation());
  using Criteria = pcl::registration::DefaultConvergenceCriteria<double>;
  const bool at_rest =
      icp.getConvergeCriteria()->getConvergenceState() == Criteria::CONVERGENCE_CRITERIA_TRANSFORM;
  const Eigen::Isometry3d last_step(icp.getLastIncrementalTransformation());
  if (!at_rest && !within_error(last_step, surface.pairs(moved_points(move, points), p.max_distance), held))
    return std::nullopt;
  return move;
}

/// In voxels as the unit of length, because the mixture of NDT's score assumes voxels of side 1.
std::optional<Eigen::Isometry3d> move_by_ndt(const Points& points, MapSurface& surface,
                                             const HeldDirections& held, const RegistrationParameters& p) {
  const double voxel = cells_per_voxel * surface.cell();
  const double step = step_per_cell * surface.cell();
  const double turn = step / held.arm;
  using Point = pcl::PointXYZ;
  pcl::NormalDistributionsTransform<Point, Point, double> ndt;
  ndt.setInputSource(to_pcl<Point>(points, 1 / voxel));
  ndt.setInputTarget(to_pcl<Point>(surface.cells_around(points, p.max_shift), 1 / voxel));
  ndt.setMaximumIterations(p.max_iterations);
  ndt.setTransformationEpsilon(step * step / (voxel * voxel));
  ndt.setTransformationRotationEpsilon(1 - turn * turn / 2);
  pcl::PointCloud<Point> moved;
  ndt.align(moved);
  if (!ndt.hasConverged() || ndt.getFinalNumIteration() >= p.max_iterations) return std::nullopt;
  Eigen::Isometry3d move(ndt.getFinalTransformation());
  move.translation() *= voxel;
  return held_part(move, held);
}

/// Why the refinement is not to be trusted; empty when it is.
std::string objection(const Registration& r, std::size_t given_pairs, const RegistrationParameters& p) {
  if (r.shift > p.max_shift)
    return fmt::format("would move a point of the cloud by {:.3g} m, at most {:g} m are allowed", r.shift,
                       p.max_shift);
  if (r.angle > p.max_angle)
    return fmt::format("would turn the cloud by {:.3g} deg, at most {:.3g} deg are allowed", r.angle / degree,
                       p.max_angle / degree);
  if (r.pairs < given_pairs / 2)
    return fmt::format("would leave {} of {} points on the map's surface", r.pairs, given_pairs);
  // Points are the same before and after; a median of noise may still grow by its own standard error.
  const double tolerance = 1 / std::sqrt(static_cast<double>(r.pairs));
  if (r.median_residual > r.given_residual * (1 + tolerance))
    return fmt::format("median distance from the map would grow from {:.3g} m to {:.3g} m", r.given_residual,
                       r.median_residual);
  return {};
}

}  // namespace

Registration register_cloud(const PointCloud& cloud, const Eigen::Isometry3d& pose, const HeightMap& map,
                            const RegistrationParameters& parameters) {
  check(parameters);
  Registration result;
  result.pose = pose;
  const GridGeometry& geometry = map.geometry();
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  Points points =
      sample_of(cloud, pose, parameters.max_points, "registration", [&](const Eigen::Vector3d& p) {
        const auto cell = geometry.find(p.x(), p.y());
        return cell && std::isfinite(elevation[geometry.index(*cell)]);
      });
  const Eigen::Vector3d origin = centred(points);
  MapSurface surface(map, origin);
  const auto given = surface.pairs(points, parameters.max_distance);
  result.pairs = given.size();
  result.given_residual = result.median_residual = median_distance(given);
  if (given.size() < parameters.min_pairs) {
    result.reason = fmt::format("{} points of the cloud lie within {:g} m of the known map, at least {} must",
                                given.size(), parameters.max_distance, parameters.min_pairs);
    return result;
  }

  const HeldDirections held = held_directions(given, parameters.max_distance, parameters.least_slope);
  result.held = static_cast<int>(held.basis.cols());
  if (result.held == 0) {
    result.reason = "the map is too rough to tell where its surface is";
    return result;
  }
  const QuietPcl quiet;
  const auto move = parameters.method == RegistrationMethod::icp
                        ? move_by_icp(points, surface, held, parameters)
                        : move_by_ndt(points, surface, held, parameters);
  if (!move) {
    result.reason = fmt::format("did not come to rest in {} iterations", parameters.max_iterations);
    return result;
  }
  const Points moved = moved_points(*move, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    result.shift = std::max(result.shift, (moved[i] - points[i]).norm());
  result.angle = Eigen::AngleAxisd(move->linear()).angle();
  const auto after = surface.pairs(moved, parameters.max_distance);
  result.pairs = after.size();
  result.median_residual = median_distance(after);
  result.reason = objection(result, given.size(), parameters);
  result.accepted = result.reason.empty();
  if (result.accepted)
    result.pose = Eigen::Translation3d(origin) * *move * Eigen::Translation3d(-origin) * pose;
  return result;
}

}  // namespace aeolian
