#include "aeolian_core/measure/plane_pose.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// A camera half a metre over a strip, leaning by 15 and 10 degrees.
CameraPose true_pose() {
  CameraPose pose;
  pose.camera = {4000, 3000, 3600, 3600, 1999.5, 1499.5, {-0.08, 0.02, 2e-4, -3e-4, 0, 0, 0, 0}};
  pose.to_camera.linear() =
      (Eigen::AngleAxisd(0.26, Eigen::Vector3d::UnitX()) *
       Eigen::AngleAxisd(-0.17, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  pose.to_camera.translation() = Eigen::Vector3d(0.01, 0.02, 0.5);
  return pose;
}

std::vector<PlanePoint> seen(const CameraPose& pose, double noise_px, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<PlanePoint> points;
  for (int i = -9; i <= 9; ++i) {
    for (const double y : {-0.003, -0.027}) {
      PlanePoint point{{0.02 * i, y}, pose.pixel({0.02 * i, y, 0})};
      point.pixel.x() += noise_px * random.normal();
      point.pixel.y() += noise_px * random.normal();
      points.push_back(point);
    }
  }
  return points;
}

TEST(PlanePose, IsExactWithoutNoise) {
  const CameraPose truth = true_pose();
  const CameraPose pose = fit_pose(seen(truth, 0, 1), truth.camera, {truth.camera.fx, 0});
  EXPECT_LT((pose.to_camera.matrix() - truth.to_camera.matrix()).norm(), 1e-9);
  EXPECT_LT(pose.rms_px, 1e-7);
}

TEST(PlanePose, StandardErrorsAreThoseOfManyFits) {
  const CameraPose truth = true_pose();
  constexpr int fits = 200;
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  for (int i = 0; i < fits; ++i) {
    const CameraPose pose =
        fit_pose(seen(truth, 0.3, static_cast<std::uint64_t>(i)), truth.camera, {truth.camera.fx, 0});
    const Eigen::AngleAxisd turn(truth.to_camera.linear() * pose.to_camera.linear().transpose());
    // `moved` says what the parameters do: undone, they must lead from the fit to the truth.
    Eigen::Matrix<double, 7, 1> step = Eigen::Matrix<double, 7, 1>::Zero();
    step.head<3>() = turn.angle() * turn.axis();
    step.segment<3>(3) = truth.to_camera.translation() - pose.moved(step).to_camera.translation();
    ASSERT_LT((pose.moved(step).to_camera.matrix() - truth.to_camera.matrix()).norm(), 1e-6);
    for (int k = 0; k < 6; ++k) squares[k] += step[k] * step[k] / pose.covariance(k, k) / fits;
  }
  for (int k = 0; k < 6; ++k) {
    EXPECT_GT(std::sqrt(squares[k]), 0.85) << "parameter " << k;
    EXPECT_LT(std::sqrt(squares[k]), 1.15) << "parameter " << k;
  }
}

TEST(PlanePose, FocalLengthIsFittedWhenItIsOnlyBelieved) {
  const CameraPose truth = true_pose();
  CameraModel believed = truth.camera;
  believed.fx = believed.fy = 1.04 * truth.camera.fx;
  const CameraPose pose = fit_pose(seen(truth, 0, 1), believed, {believed.fx, 0.35});
  EXPECT_NEAR(pose.camera.fx / truth.camera.fx, 1, 1e-3);
}

TEST(PlanePose, AMarkOutOfPlaceIsNamed) {
  const CameraPose truth = true_pose();
  auto points = seen(truth, 0.1, 1);
  points[7].pixel.x() += 15;
  try {
    fit_pose(points, truth.camera, {truth.camera.fx, 0});
    FAIL() << "a pose came out";
  } catch (const Error& error) {
    const std::string said = error.what();
    const std::string place = std::to_string(points[7].pixel.x());
    EXPECT_NE(said.find("marks disagree"), std::string::npos) << said;
    EXPECT_NE(said.find(place.substr(0, place.find('.'))), std::string::npos) << said;
  }
}

TEST(PlanePose, FewOrAlignedMarksAreRefused) {
  const CameraPose truth = true_pose();
  auto points = seen(truth, 0, 1);
  std::vector<PlanePoint> row;
  for (std::size_t i = 0; i < points.size(); i += 2) row.push_back(points[i]);
  EXPECT_THROW(fit_pose(row, truth.camera, {truth.camera.fx, 0}), Error);
  points.resize(3);
  EXPECT_THROW(fit_pose(points, truth.camera, {truth.camera.fx, 0}), Error);
}

}  // namespace
}  // namespace aeolian
