#include "aeolian_core/measure/bed_frame.hpp"

#include <cmath>
#include <string>

#include "fusion_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double noise = 0.002;

/// The bed's frame: inclined by `slope` downwards to `azimuth`.
Eigen::Isometry3d inclined(double slope, double azimuth) {
  const Eigen::Vector3d axis(-std::sin(azimuth), std::cos(azimuth), 0);
  return Eigen::Translation3d(3, -2, 0.5) * Eigen::AngleAxisd(slope, axis);
}

/// Points of 1 m x 0.8 m of a rippled bed of that frame; a share of them lies up to half a metre above it.
std::vector<Eigen::Vector3d> bed_points(const Eigen::Isometry3d& frame, std::uint64_t seed, double outliers,
                                        double ripple_height) {
  RandomStream random(seed, 0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform() - 0.5;
    const double y = 0.8 * (random.uniform() - 0.5);
    double z = ripple_height / 2 * std::sin(2 * M_PI * x / 0.1) + noise * random.normal();
    if (random.uniform() < outliers) z += 0.5 * random.uniform();
    points.push_back(frame * Eigen::Vector3d(x, y, z));
  }
  return points;
}

/// Of a direction's component, from an even spread of points over a length.
double standard_error(double scatter, double length) {
  return scatter / (length / std::sqrt(12.0)) / std::sqrt(10000.0);
}

TEST(BedFrame, FindsTheNormalWithinItsStatisticalError) {
  double chi_square = 0;
  constexpr int seeds = 20;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Eigen::Isometry3d truth = inclined(20 * degree, 0.3 * static_cast<double>(seed));
    const auto pose = looking_down(3, -2, 2);
    const Eigen::Isometry3d frame = fit_bed_frame(seen_from(pose, bed_points(truth, seed, 0, 0)), pose);
    const Eigen::Vector3d normal = truth.linear().transpose() * frame.linear().col(2);
    chi_square += std::pow(normal.x() / standard_error(noise, 1.0), 2) / seeds +
                  std::pow(normal.y() / standard_error(noise, 0.8), 2) / seeds;
    EXPECT_LT(std::abs((truth.inverse() * frame.translation()).z()), 5 * noise / std::sqrt(10000.0));
  }
  // Two degrees of freedom, 95 % efficient: 2.1 +- 0.47 over twenty seeds.
  EXPECT_GT(chi_square, 0.7);
  EXPECT_LT(chi_square, 3.6);
}

TEST(BedFrame, RipplesAndAThirdOfOutliersDoNotTiltIt) {
  for (const double slope : {0.0, 5.0, 20.0, 45.0}) {
    const Eigen::Isometry3d truth = inclined(slope * degree, 1.1);
    const auto pose = looking_down(3, -2, 2);
    const Eigen::Isometry3d frame = fit_bed_frame(seen_from(pose, bed_points(truth, 7, 0.3, 0.01)), pose);
    const double scatter = std::hypot(noise, 0.005 / std::sqrt(2.0));
    const double angle = std::acos(std::min(frame.linear().col(2).dot(truth.linear().col(2)), 1.0));
    // Outliers that hug the bed bias its height, evenly: 0.3 x 10 mm / 0.5 m of them are not told apart.
    EXPECT_LT(angle, 5 * standard_error(scatter, 0.8)) << slope;
    EXPECT_NEAR((truth.inverse() * frame.translation()).z(), 0, 0.001) << slope;
  }
}

TEST(BedFrame, AxesFollowTheMap) {
  const Eigen::Isometry3d truth = inclined(30 * degree, 0);  // down along x
  const auto pose = looking_down(3, -2, 2);
  const Eigen::Isometry3d frame = fit_bed_frame(seen_from(pose, bed_points(truth, 9, 0, 0)), pose);
  EXPECT_NEAR((frame.linear() - truth.linear()).norm(), 0, 1e-3);
  EXPECT_NEAR((frame.linear() * frame.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  EXPECT_NEAR(frame.linear().determinant(), 1, 1e-12);
  EXPECT_NEAR((frame.translation() - truth.translation()).norm(), 0, 0.02) << "the middle of the points";
}

TEST(BedFrame, GeoreferencedCoordinatesLoseNothing) {
  PointCloud cloud = seen_from(Eigen::Isometry3d::Identity(), bed_points(inclined(5 * degree, 0), 1, 0, 0));
  const Eigen::Isometry3d near = fit_bed_frame(cloud, Eigen::Isometry3d::Identity());
  cloud.origin_x = 512000;
  cloud.origin_y = 5403000;
  const Eigen::Isometry3d far = fit_bed_frame(cloud, Eigen::Isometry3d::Identity());
  EXPECT_NEAR((far.linear() - near.linear()).norm(), 0, 1e-6);
  EXPECT_NEAR((far.translation() - near.translation() - Eigen::Vector3d(512000, 5403000, 0)).norm(), 0, 1e-6);
}

TEST(BedFrame, TheSameInputsGiveTheSameBits) {
  const PointCloud cloud = seen_from(looking_down(3, -2, 2), bed_points(inclined(0.2, 1), 2, 0.3, 0.01));
  EXPECT_TRUE(fit_bed_frame(cloud, looking_down(3, -2, 2)).matrix() ==
              fit_bed_frame(cloud, looking_down(3, -2, 2)).matrix());
}

void expect_error(const PointCloud& cloud, const Eigen::Isometry3d& pose, const std::string& what) {
  try {
    fit_bed_frame(cloud, pose);
    ADD_FAILURE() << "no error: " << what;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
  }
}

TEST(BedFrame, NamesInputsThatCannotBe) {
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  expect_error(PointCloud(), pose, "0 finite points, at least 10");
  PointCloud unseen;
  for (int i = 0; i < 100; ++i) unseen.push_back(NAN, INFINITY, 0);
  expect_error(unseen, pose, "0 finite points");
  PointCloud line;
  for (int i = 0; i < 100; ++i) line.push_back(0.01F * static_cast<float>(i), 0, 0);
  expect_error(line, pose, "lie on a line");
  PointCloud same;
  for (int i = 0; i < 100; ++i) same.push_back(1, 2, 3);
  expect_error(same, pose, "lie on a line");
  PointCloud uneven = line;
  uneven.z.pop_back();
  expect_error(uneven, pose, "100 x, 100 y and 99 z");
  Eigen::Isometry3d nowhere = pose;
  nowhere.linear()(0, 0) = NAN;
  expect_error(line, nowhere, "pose of the sensor is not finite");
  expect_error(seen_from(pose, bed_points(inclined(85 * degree, 0.5), 3, 0, 0)), pose,
               "inclined by 85.0 deg");
}

}  // namespace
}  // namespace aeolian
