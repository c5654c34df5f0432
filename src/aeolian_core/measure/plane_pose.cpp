#include "aeolian_core/measure/plane_pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr double pixel_sigma = 0.02;  // what marks reach at best [px]
constexpr double found_px = 0.5;      // nor a found corner [px]
constexpr double gross_px = 3;        // no careful mark is so far off [px]

using Parameters = Eigen::Matrix<double, 7, 1>;
using Normal = Eigen::Matrix<double, 7, 7>;

struct Fit {
  CameraPose pose;
  double cost = std::numeric_limits<double>::infinity();
  Normal information = Normal::Zero();
};

/// Residuals and prior of one pose; the points weigh as 1 / (1 + (miss / 3 px)^2) so that a wrong one stands
/// out.
class Problem {
 public:
  Problem(const std::vector<PlanePoint>& points, const FocalPrior& prior) : points_(points), prior_(prior) {}

  double miss(const CameraPose& pose, std::size_t i) const {
    return (seen(pose, i) - points_[i].pixel).norm();
  }

  double cost(const CameraPose& pose) const {
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d point = in_camera(pose, i);
      if (!(point.z() > 0)) return std::numeric_limits<double>::infinity();
      const double squared = std::pow(miss(pose, i), 2);
      sum += gross_px * gross_px * std::log1p(squared / (gross_px * gross_px));
    }
    sum /= pixel_sigma * pixel_sigma;
    if (prior_.relative_sigma > 0) sum += std::pow(focal_miss(pose) / prior_.relative_sigma, 2);
    return sum;
  }

  /// Normal matrix and right side of a Gauss-Newton step.
  void linearise(const CameraPose& pose, Normal& normal, Parameters& right) const {
    normal.setZero();
    right.setZero();
    std::vector<Eigen::Matrix<double, 2, 7>> slopes(points_.size());
    for (int k = 0; k < 7; ++k) {
      if (k == 6 && prior_.relative_sigma == 0) continue;
      const double h = 1e-6;
      Parameters by = Parameters::Zero();
      by[k] = h;
      const CameraPose up = pose.moved(by);
      by[k] = -h;
      const CameraPose down = pose.moved(by);
      for (std::size_t i = 0; i < points_.size(); ++i)
        slopes[i].col(k) = (seen(up, i) - seen(down, i)) / (2 * h);
    }
    if (prior_.relative_sigma == 0)
      for (auto& slope : slopes) slope.col(6).setZero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector2d left = points_[i].pixel - seen(pose, i);
      const double weight =
          1 / (pixel_sigma * pixel_sigma) / (1 + left.squaredNorm() / (gross_px * gross_px));
      normal += weight * slopes[i].transpose() * slopes[i];
      right += weight * slopes[i].transpose() * left;
    }
    if (prior_.relative_sigma > 0) {
      const double weight = 1 / (prior_.relative_sigma * prior_.relative_sigma);
      normal(6, 6) += weight;
      right[6] -= weight * focal_miss(pose);
    } else {
      normal(6, 6) = 1;
    }
  }

 private:
  Eigen::Vector3d in_camera(const CameraPose& pose, std::size_t i) const {
    const Eigen::Vector2d& p = points_[i].position;
    return pose.to_camera * Eigen::Vector3d(p.x(), p.y(), 0);
  }
  Eigen::Vector2d seen(const CameraPose& pose, std::size_t i) const {
    return pose.camera.pixel(in_camera(pose, i));
  }
  double focal_miss(const CameraPose& pose) const { return std::log(pose.camera.fx / prior_.focal_px); }

  const std::vector<PlanePoint>& points_;
  FocalPrior prior_;
};

/// Levenberg-Marquardt from a start.
Fit refine(const Problem& problem, const CameraPose& start) {
  Fit fit{start, problem.cost(start), Normal::Zero()};
  double damping = 1e-3;
  for (int i = 0; i < 100 && damping < 1e12; ++i) {
    Parameters right;
    problem.linearise(fit.pose, fit.information, right);
    Normal damped = fit.information;
    damped.diagonal() *= 1 + damping;
    const Parameters step = damped.ldlt().solve(right);
    const CameraPose next = fit.pose.moved(step);
    const double cost = problem.cost(next);
    if (cost <= fit.cost) {
      const bool settled = fit.cost - cost < 1e-10 * (1 + cost);
      fit.pose = next;
      fit.cost = cost;
      damping = std::max(1e-12, damping / 10);
      if (settled) break;
    } else {
      damping *= 10;
    }
  }
  return fit;
}

/// The two poses that a plane's picture allows, from the points alone.
std::vector<CameraPose> starts(const std::vector<PlanePoint>& points, const CameraModel& camera) {
  std::vector<cv::Point3d> positions;
  std::vector<cv::Point2d> directions;
  for (const PlanePoint& point : points) {
    positions.emplace_back(point.position.x(), point.position.y(), 0);
    const Eigen::Vector3d ray = camera.ray(point.pixel);
    directions.emplace_back(ray.x(), ray.y());
  }
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::solvePnPGeneric(positions, directions, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), turns, shifts, false,
                      cv::SOLVEPNP_IPPE);
  std::vector<CameraPose> result;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Eigen::Vector3d turn(turns[i].at<double>(0), turns[i].at<double>(1), turns[i].at<double>(2));
    CameraPose pose;
    pose.camera = camera;
    pose.to_camera.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.norm() > 0 ? turn.normalized() : Eigen::Vector3d::UnitX().eval())
            .toRotationMatrix();
    pose.to_camera.translation() =
        Eigen::Vector3d(shifts[i].at<double>(0), shifts[i].at<double>(1), shifts[i].at<double>(2));
    result.push_back(pose);
  }
  return result;
}

bool from_above(const CameraPose& pose) { return pose.to_camera.inverse().translation().z() > 0; }

void require_spread(const std::vector<PlanePoint>& points) {
  if (points.size() < 4)
    throw Error(fmt::format("only {} marks: a pose needs four or more, not on one line", points.size()));
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& point : points) mean += point.position / static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& point : points) spread += (point.position - mean) * (point.position - mean).transpose();
  const Eigen::Vector2d squares = spread.selfadjointView<Eigen::Lower>().eigenvalues();
  if (squares[0] < 1e-6 * squares[1])
    throw Error(
        "the marks lie on one line, which does not fix a tilted camera: give markers, a second row of "
        "marks with x and y, or 'camera.plumb: true' for a camera that looks straight down");
}

/// The points that agree with a pose. Throws Error for one given by a person that does not.
std::vector<PlanePoint> agreeing(const Problem& problem, const std::vector<PlanePoint>& points,
                                 const CameraPose& pose) {
  std::vector<double> misses;
  for (std::size_t i = 0; i < points.size(); ++i) misses.push_back(problem.miss(pose, i));
  const double typical = median(misses);
  std::vector<PlanePoint> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double most = points[i].found ? std::max(found_px, 6 * typical) : std::max(gross_px, 5 * typical);
    if (typical <= gross_px && misses[i] <= most) {
      result.push_back(points[i]);
    } else if (!points[i].found || typical > gross_px) {
      throw Error(
          fmt::format("scale marks disagree: the mark at pixel ({:.1f}, {:.1f}) is {:.1f} px from where the "
                      "others put it",
                      points[i].pixel.x(), points[i].pixel.y(), misses[i]));
    }
  }
  return result;
}

}  // namespace

CameraPose CameraPose::moved(const Parameters& by) const {
  CameraPose result = *this;
  const Eigen::Vector3d turn = by.head<3>();
  const double angle = turn.norm();
  if (angle > 0) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    result.to_camera.linear() = rotation * to_camera.linear();
  }
  result.to_camera.translation() += by.segment<3>(3);
  result.camera.fx *= std::exp(by[6]);
  result.camera.fy *= std::exp(by[6]);
  return result;
}

CameraPose fit_pose(const std::vector<PlanePoint>& points, const CameraModel& camera,
                    const FocalPrior& prior) {
  require_spread(points);
  const Problem problem(points, prior);
  Fit best;
  bool below = false;
  for (const CameraPose& start : starts(points, camera)) {
    if (!from_above(start)) {
      below = true;
      continue;
    }
    Fit fit = refine(problem, start);
    if (from_above(fit.pose) && fit.cost < best.cost) best = fit;
  }
  if (!std::isfinite(best.cost))
    throw Error(below ? "the marks are seen mirrored: x along the scale, y on the top face and z up must be "
                        "right-handed"
                      : "no camera can see the marks where they are said to be");
  const std::vector<PlanePoint> good = agreeing(problem, points, best.pose);
  if (good.size() < points.size()) return fit_pose(good, camera, prior);

  CameraPose pose = best.pose;
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) squares += std::pow(problem.miss(pose, i), 2);
  const double count = static_cast<double>(points.size());
  pose.rms_px = std::sqrt(squares / count);
  const double freedom = 2 * count - (prior.relative_sigma > 0 ? 7 : 6);
  const double excess = freedom > 0 ? std::max(1.0, squares / freedom / (pixel_sigma * pixel_sigma)) : 1.0;
  pose.covariance = excess * best.information.inverse();
  if (prior.relative_sigma == 0) {
    pose.covariance.row(6).setZero();
    pose.covariance.col(6).setZero();
  }
  return pose;
}

}  // namespace aeolian
