// Five captures of a room by a hand-held depth camera (structured light), registered onto one another: the
// height map of one, seen along the camera's axis, and the others laid onto it.
//
// The published noise of this kind of camera is random noise alone. This one has stripes and blobs of its own
// beside (a flat wall comes out 1.5 to 2 times as rough), which no rigid move takes away: most pairs stay
// a little above the published noise. What is asked of them is this camera's noise, as its wall shows it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "../../shared_data.hpp"
#include "fusion_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/measure/bed_frame.hpp"
#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/measure/map_surface.hpp"
#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr std::size_t captures = 5;

/// config/sensors/kinect_v1.yaml
constexpr SensorNoise kinect{0.001504, -0.00152, 0.0019, 0.078 * degree, 0.2, 0};

/// Where the camera stood, from a search over its pan: translation [m] and rotation vector [deg] to the first
/// capture, in its optical frame, to the centimetre and the degree, as a pan-tilt head would tell.
constexpr double roughly[captures][6] = {{0, 0, 0, 0, 0, 0},
                                         {-0.10, 0.01, 0.00, 0, 1, 0},
                                         {-0.26, 0.01, 0.02, 0, -1, -1},
                                         {-0.44, -0.01, 0.03, 0, -7, 0},
                                         {-0.59, -0.01, 0.03, 0, -8, 1}};

Eigen::Isometry3d rough_pose(std::size_t capture) {
  const double* p = roughly[capture];
  const Eigen::Vector3d turn = degree * Eigen::Vector3d(p[3], p[4], p[5]);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) pose.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
  return looking_down(0, 0, 0) * pose;
}

std::string folder() { return (shared_data() / "depth-camera").string(); }

class Captures : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder())) GTEST_SKIP() << "no " << folder();
    for (std::size_t i = 0; i < captures; ++i)
      clouds.push_back(read_cloud(folder() + "/capture000" + std::to_string(i + 1) + ".pcd"));
  }

  static HeightFusion empty_map() {
    FusionParameters parameters;
    parameters.sensor = kinect;
    parameters.sensor.min_range = 0.4;
    parameters.sensor.max_range = 4;
    return HeightFusion(GridGeometry(-2.5, -1.5, 0.01, 400, 300), parameters);
  }

  /// First with all that is within 15 cm of the map, then with what is within 5.
  static Registration refine(const PointCloud& cloud, const Eigen::Isometry3d& pose, const HeightMap& map) {
    RegistrationParameters parameters;
    parameters.max_points = 8000;
    parameters.max_shift = 0.2;
    parameters.max_angle = 5 * degree;
    parameters.max_distance = 0.15;
    const Registration first = register_cloud(cloud, pose, map, parameters);
    EXPECT_TRUE(first.accepted) << first.reason;
    parameters.max_distance = 0.05;
    return register_cloud(cloud, first.pose, map, parameters);
  }

  /// Median of distance from the map over the published noise at the point's range.
  static double relative_residual(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                  const HeightMap& map) {
    MapSurface surface(map, Eigen::Vector3d::Zero());
    std::vector<double> relative;
    for (std::size_t i = 0; i < cloud.size(); i += 7) {
      const Eigen::Vector3d seen = Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]).cast<double>();
      if (!seen.allFinite()) continue;
      const auto pair = surface.under(pose * seen);
      if (pair && std::abs(pair->residual) <= 0.05)
        relative.push_back(std::abs(pair->residual) / kinect.along_ray(seen.norm(), 1));
    }
    return median(std::move(relative));
  }

  /// Robust standard deviation of what a capture shows of the wall (a window at the upper right of the
  /// picture) about its plane, over the published noise.
  static double noise_of_wall(const PointCloud& cloud) {
    PointCloud wall;
    for (std::size_t row = 50; row < 180; ++row)
      for (std::size_t i = row * 640 + 460; i < row * 640 + 600; ++i)
        if (std::isfinite(cloud.z[i])) wall.push_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    const Eigen::Isometry3d pose = looking_down(0, 0, 0);
    const Eigen::Isometry3d to_plane = fit_bed_frame(wall, pose).inverse() * pose;
    std::vector<double> relative;
    for (std::size_t i = 0; i < wall.size(); ++i) {
      const Eigen::Vector3d seen = Eigen::Vector3f(wall.x[i], wall.y[i], wall.z[i]).cast<double>();
      relative.push_back(std::abs((to_plane * seen).z()) / kinect.along_ray(seen.norm(), 1));
    }
    return sigma_per_median * median(std::move(relative));
  }

  /// The least of the captures'.
  double noise_of_camera() const {
    double least = INFINITY;
    for (const PointCloud& cloud : clouds) least = std::min(least, noise_of_wall(cloud));
    return least;
  }

  std::vector<PointCloud> clouds;
};

TEST_F(Captures, RegisterOntoOneAnother) {
  const double this_camera = noise_of_camera();
  std::printf("a wall, captured once, is rough by %.2f of the published noise\n", this_camera);
  for (std::size_t onto = 0; onto < captures; ++onto) {
    HeightFusion fusion = empty_map();
    fusion.add(clouds[onto], rough_pose(onto), 0);
    for (std::size_t i = 0; i < captures; ++i) {
      if (i == onto) continue;
      const Registration r = refine(clouds[i], rough_pose(i), fusion.map());
      EXPECT_TRUE(r.accepted) << r.reason;
      const double relative = relative_residual(clouds[i], r.pose, fusion.map());
      EXPECT_LT(relative, this_camera) << i + 1 << " onto " << onto + 1;
      std::printf("capture %zu onto %zu: %5zu points, median residual %.1f mm, %.2f of the published noise\n",
                  i + 1, onto + 1, r.pairs, 1e3 * r.median_residual, relative);
    }
  }
}

TEST_F(Captures, EachOntoTheMapOfThoseBefore) {
  const double this_camera = noise_of_camera();
  HeightFusion fusion = empty_map();
  fusion.add(clouds[0], rough_pose(0), 0);
  for (std::size_t i = 1; i < captures; ++i) {
    const Registration r = refine(clouds[i], rough_pose(i), fusion.map());
    EXPECT_TRUE(r.accepted) << r.reason;
    const double relative = relative_residual(clouds[i], r.pose, fusion.map());
    EXPECT_LT(relative, this_camera) << i + 1;
    std::printf("capture %zu onto the map before it: median residual %.1f mm, %.2f of the published noise\n",
                i + 1, 1e3 * r.median_residual, relative);
    fusion.add(clouds[i], r.pose, static_cast<double>(i));
  }
}

}  // namespace
}  // namespace aeolian
