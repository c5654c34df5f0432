#include "aeolian_core/measure/setup_geometry.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "aeolian_core/measure/strip_markers.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

[[noreturn]] void refuse_mark(double x, double pixels) {
  throw Error(
      fmt::format("scale marks disagree: the mark x = {:g} mm is {:.1f} px from where the others put it",
                  1e3 * x, pixels));
}

constexpr double plumb_sigma = 0.5 * M_PI / 180;  // how well a camera is hung [rad]
constexpr double exif_sigma = 0.05;               // of a focal length told by EXIF, relative
constexpr double guessed_sigma = 0.35;            // of a focal length nobody tells

struct Line {
  Eigen::Vector2d point;
  Eigen::Vector2d direction;
};

Line fit_line(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& p : points) spread += (p - mean) * (p - mean).transpose();
  return {mean, Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1)};
}

/// Slope and value at zero of a line through (x, y), and the standard error of the slope.
struct Regression {
  double slope = 0, offset = 0, slope_sigma = 0, worst = 0;
  std::size_t worst_at = 0;
};

Regression regress(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  Regression result;
  result.slope = xy / xx;
  result.offset = my - result.slope * mx;
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double miss = std::abs(y[i] - result.offset - result.slope * x[i]);
    squares += miss * miss;
    if (miss > result.worst) result.worst = miss, result.worst_at = i;
  }
  result.slope_sigma = n > 2 ? std::sqrt(squares / (n - 2) / xx) : 0;
  return result;
}

void require_size(const Photo& photo, const CameraModel& camera) {
  if (photo.width_px != camera.width_px || photo.height_px != camera.height_px)
    throw Error(fmt::format("the photo has {} x {} pixels, the camera of the setup {} x {}", photo.width_px,
                            photo.height_px, camera.width_px, camera.height_px));
}

CameraModel unknown_camera(const Photo& photo, double focal) {
  CameraModel camera;
  camera.width_px = photo.width_px;
  camera.height_px = photo.height_px;
  camera.fx = camera.fy = focal;
  camera.cx = (photo.width_px - 1) / 2.0;
  camera.cy = (photo.height_px - 1) / 2.0;
  return camera;
}

/// Marks with x and y, or nothing when they have x alone.
std::vector<PlanePoint> plane_points(const Photo& photo, const PhotoSetup& setup) {
  std::vector<PlanePoint> points;
  if (setup.markers) points = find_markers(photo, *setup.markers);
  const bool plane =
      std::all_of(setup.scale.begin(), setup.scale.end(), [](const auto& m) { return m.y.has_value(); });
  if (plane || setup.markers)
    for (const auto& mark : setup.scale)
      if (mark.y) points.push_back({{mark.x, *mark.y}, mark.pixel});
  return points;
}

/// A camera that looks straight down on a row of marks.
CameraPose plumb_pose(const PhotoSetup& setup, const CameraModel& camera) {
  std::vector<Eigen::Vector2d> directions;  // seen, at unit depth
  for (const auto& mark : setup.scale) directions.push_back(camera.ray(mark.pixel).head<2>());
  std::vector<Eigen::Vector2d> edge;
  for (const auto& pixel : setup.line_px) edge.push_back(camera.ray(pixel).head<2>());
  Line line = fit_line(edge.size() >= 2 ? edge : directions);
  std::vector<double> u;
  for (const auto& d : directions) u.push_back(d.dot(line.direction));
  if ((u.back() - u.front()) * (setup.scale.back().x - setup.scale.front().x) < 0) {
    line.direction = -line.direction;
    for (double& value : u) value = -value;
  }
  // (x cos e - X) / (H - x sin e) = u is linear in the camera's height H and place X.
  const double c = std::cos(setup.inclination);
  const double s = std::sin(setup.inclination);
  std::vector<double> right;
  for (std::size_t i = 0; i < u.size(); ++i) right.push_back(setup.scale[i].x * (c + u[i] * s));
  const Regression fit = regress(u, right);
  if (fit.worst * camera.fx / fit.slope > 3)
    refuse_mark(setup.scale[fit.worst_at].x, fit.worst * camera.fx / fit.slope);
  const Eigen::Vector2d across(line.direction.y(), -line.direction.x());
  const double height = fit.slope;
  const Eigen::Vector3d centre(fit.offset, -line.point.dot(across) * height, height);
  Eigen::Matrix3d level_to_camera;
  level_to_camera << line.direction.x(), across.x(), 0, line.direction.y(), across.y(), 0, 0, 0, -1;
  const Eigen::Matrix3d to_level =
      Eigen::AngleAxisd(-setup.inclination, Eigen::Vector3d::UnitY()).toRotationMatrix();
  CameraPose pose;
  pose.camera = camera;
  pose.to_camera.linear() = level_to_camera * to_level;
  pose.to_camera.translation() = -level_to_camera * centre;
  pose.covariance(0, 0) = pose.covariance(1, 1) = plumb_sigma * plumb_sigma;
  pose.covariance(5, 5) = fit.slope_sigma * fit.slope_sigma;
  double squares = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    squares += std::pow((right[i] - fit.offset - fit.slope * u[i]) * camera.fx / height, 2);
  pose.rms_px = std::sqrt(squares / static_cast<double>(u.size()));
  return pose;
}

void require_edge_agreement(const PhotoGeometry& geometry, const PhotoSetup& setup) {
  for (const auto& pixel : setup.line_px) {
    const Eigen::Vector2d plan = geometry.top_face(pixel);
    const double miss = (geometry.pixel(plan.x(), 0) - pixel).norm();
    if (miss > 5 && std::abs(plan.y()) > 1e-3)
      throw Error(
          fmt::format("straightedge.line_px: the point ({:.1f}, {:.1f}) lies {:.1f} px from the casting edge "
                      "y = 0 of the marks",
                      pixel.x(), pixel.y(), miss));
  }
}

FocalPrior focal_prior(const Photo& photo, const PhotoSetup& setup) {
  if (setup.camera) return {setup.camera->fx, 0};
  if (photo.exif_focal_px) return {*photo.exif_focal_px, exif_sigma};
  return {static_cast<double>(std::max(photo.width_px, photo.height_px)), guessed_sigma};
}

void full_geometry(const Photo& photo, const PhotoSetup& setup, const std::vector<PlanePoint>& points,
                   SetupGeometry& result) {
  const FocalPrior prior = focal_prior(photo, setup);
  const CameraModel camera = setup.camera ? *setup.camera : unknown_camera(photo, prior.focal_px);
  CameraPose pose;
  if (points.empty() && setup.plumb) {
    if (!setup.camera && !photo.exif_focal_px)
      throw Error("camera.plumb needs the focal length: give camera.camera_matrix, or use --mode overhead");
    pose = plumb_pose(setup, camera);
    pose.covariance(6, 6) = prior.relative_sigma * prior.relative_sigma;
  } else if (points.empty()) {
    throw Error(
        "marks along one row alone do not fix a tilted camera: give markers, a second row of marks with x "
        "and y, or 'camera.plumb: true' for a camera that looks straight down; or use --mode overhead");
  } else {
    pose = fit_pose(points, camera, prior);
  }
  if (!setup.camera)
    result.remarks.push_back(
        fmt::format("no calibrated camera: focal length {:.0f} px, good to {:.1f} %, no lens distortion",
                    pose.camera.fx, 100 * std::sqrt(pose.covariance(6, 6))));
  result.pose = pose;
  result.geometry = std::make_shared<FullGeometry>(pose, setup.inclination);
  // What the residuals of the marks leave open in lengths along the straightedge.
  double span = 0;
  for (const auto& point : points)
    span = std::max(span, std::abs(point.position.x() - points.front().position.x()));
  if (span > 0)
    result.scale_sigma = std::max(0.1, pose.rms_px) * pose.to_camera.translation().norm() / pose.camera.fx /
                         span / std::sqrt(static_cast<double>(points.size()) / 4);
}

void overhead_geometry(const PhotoSetup& setup, const std::vector<PlanePoint>& points,
                       SetupGeometry& result) {
  Eigen::Vector2d origin;
  Eigen::Vector2d along;
  double scale = 0;
  if (!points.empty()) {
    // pixel = (a, b) + x (c, d) + y (d, -c): linear least squares.
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const auto& point : points) {
      Eigen::Matrix<double, 2, 4> row;
      row << 1, 0, point.position.x(), point.position.y(), 0, 1, -point.position.y(), point.position.x();
      normal += row.transpose() * row;
      right += row.transpose() * point.pixel;
    }
    const Eigen::Vector4d fit = normal.ldlt().solve(right);
    origin = fit.head<2>();
    scale = fit.tail<2>().norm();
    along = fit.tail<2>() / scale;
  } else {
    std::vector<Eigen::Vector2d> marks;
    for (const auto& mark : setup.scale) marks.push_back(mark.pixel);
    const Line line = fit_line(setup.line_px.size() >= 2 ? setup.line_px : marks);
    std::vector<double> x;
    std::vector<double> t;
    for (const auto& mark : setup.scale) {
      x.push_back(mark.x);
      t.push_back((mark.pixel - line.point).dot(line.direction));
    }
    const Regression fit = regress(x, t);
    if (fit.worst > std::max(3.0, 0.02 * std::abs(t.back() - t.front())))
      refuse_mark(x[fit.worst_at], fit.worst);
    scale = std::abs(fit.slope);
    along = fit.slope > 0 ? line.direction : Eigen::Vector2d(-line.direction);
    origin = line.point + fit.offset * line.direction;
    result.scale_sigma = fit.slope_sigma / scale;
  }
  if (setup.line_px.size() >= 2 && !points.empty()) {
    const Line line = fit_line(setup.line_px);
    const double sign = line.direction.dot(along) > 0 ? 1 : -1;
    along = sign * line.direction;
    origin = line.point + (origin - line.point).dot(along) * along;
  }
  result.geometry = std::make_shared<OverheadGeometry>(origin, along, scale, setup.inclination);
}

/// Takes from positions on the top face where it is, and with that where the shadow falls.
void place_face(const std::vector<Eigen::Vector2d>& positions, int shadow_side, SetupGeometry& result) {
  result.side = shadow_side;
  if (positions.empty()) return;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& position : positions) mean += position / static_cast<double>(positions.size());
  result.middle = mean.x();
  if (shadow_side == 0 && std::abs(mean.y()) > 1e-3) result.side = mean.y() > 0 ? -1 : 1;
}

/// Where the setup says that marks are, without looking for them.
std::vector<Eigen::Vector2d> noted_positions(const PhotoSetup& setup) {
  std::vector<Eigen::Vector2d> positions;
  for (const auto& mark : setup.scale) positions.emplace_back(mark.x, mark.y.value_or(0));
  if (setup.markers)
    for (const auto& centre : setup.markers->centres) positions.push_back(centre.position);
  return positions;
}

}  // namespace

SetupGeometry setup_geometry(const Photo& photo, const PhotoSetup& setup, ProfileMode mode,
                             const std::optional<Eigen::Isometry3d>& known) {
  if (setup.camera) require_size(photo, *setup.camera);
  SetupGeometry result;
  if (known) {
    if (!setup.camera) throw Error("a pose of the camera needs its calibration too");
    CameraPose pose;
    pose.camera = *setup.camera;
    pose.to_camera = *known;
    result.pose = pose;
    result.geometry = std::make_shared<FullGeometry>(pose, setup.inclination);
    place_face(noted_positions(setup), setup.shadow_side, result);
    return result;
  }
  if (!setup.markers && setup.scale.size() < 2)
    throw Error("straightedge: two or more scale_px_mm marks or markers must be given");
  const std::vector<PlanePoint> points = plane_points(photo, setup);
  std::vector<Eigen::Vector2d> positions;
  for (const auto& point : points) {
    positions.push_back(point.position);
    result.mark_px.push_back(point.pixel);
  }
  if (points.empty())
    for (const auto& mark : setup.scale) {
      positions.emplace_back(mark.x, 0);
      result.mark_px.push_back(mark.pixel);
    }
  place_face(positions, setup.shadow_side, result);
  if (mode == ProfileMode::full) {
    full_geometry(photo, setup, points, result);
    require_edge_agreement(*result.geometry, setup);
  } else {
    overhead_geometry(setup, points, result);
  }
  return result;
}

}  // namespace aeolian
