#include "aeolian_core/measure/camera_model.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace aeolian {
namespace {

CameraModel camera(const std::array<double, 8>& distortion) {
  return {4000, 3000, 3100, 3108, 2010, 1490, distortion};
}

class Lenses : public testing::TestWithParam<std::array<double, 8>> {};

TEST_P(Lenses, SeePointsWhereOpenCvDoes) {
  const CameraModel model = camera(GetParam());
  const cv::Matx33d matrix(model.fx, 0, model.cx, 0, model.fy, model.cy, 0, 0, 1);
  const std::vector<double> distortion(GetParam().begin(), GetParam().end());
  for (double x = -0.5; x <= 0.5; x += 0.1) {
    for (double y = -0.4; y <= 0.4; y += 0.1) {
      std::vector<cv::Point2d> theirs;
      cv::projectPoints(std::vector<cv::Point3d>{{2 * x, 2 * y, 2}}, cv::Vec3d(), cv::Vec3d(), matrix,
                        distortion, theirs);
      const Eigen::Vector2d ours = model.pixel({2 * x, 2 * y, 2});
      EXPECT_NEAR(ours.x(), theirs[0].x, 1e-9);
      EXPECT_NEAR(ours.y(), theirs[0].y, 1e-9);
    }
  }
}

TEST_P(Lenses, RayAndPixelUndoEachOther) {
  const CameraModel model = camera(GetParam());
  for (double u = 0; u < 4000; u += 199.5) {
    for (double v = 0; v < 3000; v += 199.25) {
      const Eigen::Vector3d ray = model.ray({u, v});
      EXPECT_EQ(ray.z(), 1);
      EXPECT_LT((model.pixel(ray) - Eigen::Vector2d(u, v)).norm(), 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    CameraModel, Lenses,
    testing::Values(std::array<double, 8>{}, std::array<double, 8>{-0.12, 0.04, 8e-4, -6e-4, 0.01, 0, 0, 0},
                    std::array<double, 8>{0.2, -0.03, -5e-4, 9e-4, 0.004, 0.28, -0.01, 0.002}));

}  // namespace
}  // namespace aeolian
