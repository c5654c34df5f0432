#include "aeolian_core/measure/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// A sensor at some height that looks straight down (its z axis points to the ground).
Eigen::Isometry3d looking_down(double x, double y, double z) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return pose;
}

/// Points of the map frame as the sensor sees them.
PointCloud seen_from(const Eigen::Isometry3d& pose, const std::vector<Eigen::Vector3d>& points) {
  PointCloud cloud;
  for (const auto& p : points) {
    const Eigen::Vector3f q = (pose.inverse() * p).cast<float>();
    cloud.push_back(q.x(), q.y(), q.z());
  }
  return cloud;
}

/// The centre of every cell at one height.
std::vector<Eigen::Vector3d> level_points(const GridGeometry& g, double height) {
  std::vector<Eigen::Vector3d> points;
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 0; ix < g.nx(); ++ix) points.emplace_back(g.x(ix), g.y(iy), height);
  return points;
}

/// A cloud of one point that falls into the middle of the only cell of a 1 x 1 map at height z.
struct OneCell {
  GridGeometry geometry{0, 0, 1, 1, 1};
  Eigen::Isometry3d pose = looking_down(0.5, 0.5, 2);
  PointCloud at(double z) const { return seen_from(pose, {{0.5, 0.5, z}}); }
};

// Rays at all slants onto a noisy plane: bias within its own standard error, stated variance right by
// chi-square.
TEST(Fusion, StatesItsErrorRightly) {
  FusionParameters p;
  p.sensor.range_sigma = 0.001;
  p.change_rate = 0;
  const GridGeometry g(-0.5, -0.5, 0.1, 10, 10);
  const Eigen::Isometry3d pose = looking_down(0, 0, 0.6);
  const double plane = 0.0123;
  double chi2 = 0;
  double weighted_error = 0;
  double weight = 0;
  int cells = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    HeightFusion fusion(g, p);
    for (std::uint64_t scan = 0; scan < 3; ++scan) {
      RandomStream random(seed, scan);
      PointCloud cloud;
      for (int i = 0; i < 1000; ++i) {
        const Eigen::Vector3d ground(random.uniform() - 0.5, random.uniform() - 0.5, plane);
        const Eigen::Vector3d ray = pose.inverse() * ground;
        const Eigen::Vector3f q =
            (ray * (1 + p.sensor.range_sigma * random.normal() / ray.norm())).cast<float>();
        cloud.push_back(q.x(), q.y(), q.z());
      }
      fusion.add(cloud, pose, static_cast<double>(scan));
    }
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double error = static_cast<double>(fusion.map().layer(layer::elevation)[i]) - plane;
      const double variance = static_cast<double>(fusion.map().layer(layer::variance)[i]);
      chi2 += error * error / variance;
      weighted_error += error / variance;
      weight += 1 / variance;
      ++cells;
    }
  }
  EXPECT_NEAR(chi2 / cells, 1, 0.1);
  EXPECT_LT(std::abs(weighted_error / weight), 4 / std::sqrt(weight));
}

TEST(Fusion, DoesNotDependOnTheOrderOfPoints) {
  const GridGeometry g(0, 0, 0.02, 50, 50);
  const Eigen::Isometry3d pose = looking_down(0.5, 0.5, 1.5);
  RandomStream random(7, 0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 50000; ++i)
    points.emplace_back(random.uniform(), random.uniform(), 0.01 * random.normal());
  HeightFusion forward(g, {});
  HeightFusion backward(g, {});
  forward.add(seen_from(pose, points), pose, 0);
  std::reverse(points.begin(), points.end());
  backward.add(seen_from(pose, points), pose, 0);
  for (std::size_t i = 0; i < g.size(); ++i)
    EXPECT_NEAR(forward.map().layer(layer::elevation)[i], backward.map().layer(layer::elevation)[i], 1e-6);
}

// A surface that rises steadily is followed with the lag of a steady-state filter, not lost.
TEST(Fusion, FollowsARamp) {
  FusionParameters p;
  p.change_rate = 2e-4;
  const OneCell world;
  HeightFusion fusion(world.geometry, p);
  const double speed = 1e-5;
  for (int k = 0; k <= 600; ++k) {
    const auto result = fusion.add(world.at(speed * k), world.pose, k);
    EXPECT_EQ(result.outlier_cells, 0U);
  }
  // Riccati: P = (Q + sqrt(Q^2 + 4 Q R)) / 2 before the update; the lag of a ramp is speed (1 - K) / K.
  const double q = p.change_rate * p.change_rate;
  const double r = p.sensor.range_sigma * p.sensor.range_sigma;
  const double predicted = (q + std::sqrt(q * q + 4 * q * r)) / 2;
  const double gain = predicted / (predicted + r);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], speed * 600 - speed * (1 - gain) / gain, 2e-7);
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], gain * r, 1e-3 * r);
}

TEST(Fusion, RefusesAnOutlierAndAcceptsAStepAfterItsPatience) {
  const OneCell world;
  FusionParameters p;
  p.gate_patience = 2;
  HeightFusion fusion(world.geometry, p);
  for (int k = 0; k < 5; ++k) fusion.add(world.at(0), world.pose, k);

  auto result = fusion.add(world.at(0.05), world.pose, 5);
  EXPECT_EQ(result.outlier_cells, 1U);
  EXPECT_TRUE(result.changed.empty());
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0, 1e-6);

  // An inlier between two outliers starts the count anew.
  fusion.add(world.at(0), world.pose, 6);
  EXPECT_EQ(fusion.add(world.at(0.05), world.pose, 7).outlier_cells, 1U);
  EXPECT_EQ(fusion.add(world.at(0.05), world.pose, 8).outlier_cells, 1U);
  result = fusion.add(world.at(0.05), world.pose, 9);
  EXPECT_EQ(result.outlier_cells, 0U);
  EXPECT_EQ(result.changed.count(), 1);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.05, 1e-6);
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], 1e-6, 1e-10);
}

TEST(Fusion, CountsWhatItCannotUse) {
  const GridGeometry g(0, 0, 0.1, 10, 10);
  FusionParameters p;
  p.min_range = 0.1;
  p.max_range = 5;
  const Eigen::Isometry3d pose = looking_down(0.5, 0.5, 1);
  const float nan = std::nanf("");
  const float inf = std::numeric_limits<float>::infinity();
  PointCloud cloud;
  cloud.push_back(nan, 0, 1);
  cloud.push_back(0, inf, 1);
  cloud.push_back(0, 0, -inf);
  cloud.push_back(0, 0, 0);
  cloud.push_back(0, 0, 0.05F);
  cloud.push_back(0, 0, 6);
  cloud.push_back(2, 0, 1);
  cloud.push_back(0.1F, 0, 1);
  HeightFusion fusion(g, p);
  const auto result = fusion.add(cloud, pose, 0);
  EXPECT_EQ(result.not_finite, 3U);
  EXPECT_EQ(result.out_of_range, 3U);
  EXPECT_EQ(result.outside, 1U);
  EXPECT_EQ(result.used, 1U);
  EXPECT_EQ(count_known(fusion.map().layer(layer::elevation)), 1U);
  EXPECT_EQ(result.changed.count(), 1);

  p.min_range = 0;
  HeightFusion no_least(g, p);
  PointCloud zero;
  zero.push_back(0, 0, 0);
  EXPECT_EQ(no_least.add(zero, pose, 0).out_of_range, 1U);
}

// 500 km east, 5000 km north: a float there has steps of half a metre.
TEST(Fusion, KeepsMillimetresInUtmCoordinates) {
  const double east = 500123.4567;
  const double north = 5000765.4321;
  const GridGeometry g(east, north, 0.002, 100, 50);
  const Eigen::Isometry3d pose = looking_down(east + 0.1, north + 0.05, 101.2);
  PointCloud cloud;
  for (const auto& p : level_points(g, 100))
    cloud.push_back(static_cast<float>(p.x() - pose.translation().x()),
                    static_cast<float>(pose.translation().y() - p.y()),
                    1.2F + 0.001F * static_cast<float>(cloud.size() % 7));
  HeightFusion fusion(g, {});
  EXPECT_EQ(fusion.add(cloud, pose, 0).used, g.size());
  for (std::size_t i = 0; i < g.size(); ++i)
    EXPECT_NEAR(fusion.map().layer(layer::elevation)[i], 100 - 0.001 * static_cast<double>(i % 7), 1e-5);
}

// The same from a file: the cloud carries the large origin, the pose is the identity.
TEST(Fusion, TakesGeoreferencedClouds) {
  const GridGeometry g(500000.25, 5000000.25, 0.5, 20, 20);
  PointCloud cloud;
  cloud.origin_x = 500000;
  cloud.origin_y = 5000000;
  cloud.origin_z = 300;
  for (const auto& p : level_points(g, 312.5))
    cloud.push_back(static_cast<float>(p.x() - 500000), static_cast<float>(p.y() - 5000000), 12.5F);
  FusionParameters p;
  p.sensor.range_sigma = 0.03;
  HeightFusion fusion(g, p);
  const auto result = fusion.add(cloud, Eigen::Isometry3d::Identity(), 0);
  EXPECT_EQ(result.used, g.size());
  EXPECT_EQ(fusion.map().layer(layer::elevation)[57], 312.5F);
  EXPECT_NEAR(fusion.map().layer(layer::variance)[57], 9e-4, 1e-9);
}

TEST(Fusion, KeepsTheMapWhenTheClockJumpsBack) {
  const OneCell world;
  FusionParameters p;
  p.change_rate = 1e-3;
  HeightFusion fusion(world.geometry, p);
  fusion.add(world.at(0.01), world.pose, 1000);
  const float variance = fusion.map().layer(layer::variance)[0];

  const float elevation = fusion.map().layer(layer::elevation)[0];

  fusion.add(PointCloud{}, world.pose, 10);
  EXPECT_EQ(fusion.map().layer(layer::elevation)[0], elevation);
  EXPECT_EQ(fusion.map().layer(layer::variance)[0], variance);

  // Four seconds later by the new clock the surface may have walked by 2 mm: variance 4e-6 before the update.
  fusion.add(world.at(0.011), world.pose, 14);
  const double predicted = static_cast<double>(variance) + 4e-6;
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], predicted * 1e-6 / (predicted + 1e-6), 1e-9);
}

TEST(Fusion, TakesTwoCloudsOfOneStampAsOneSurface) {
  const OneCell world;
  FusionParameters p;
  p.change_rate = 1;
  HeightFusion fusion(world.geometry, p);
  fusion.add(world.at(0.000), world.pose, 3);
  fusion.add(world.at(0.001), world.pose, 3);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.0005, 1e-6);
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], 0.5e-6, 1e-10);
}

TEST(Fusion, ReportsChangedTilesOnly) {
  const GridGeometry g(0, 0, 0.01, 100, 100);
  HeightFusion fusion(g, {});
  const Eigen::Isometry3d pose = looking_down(0.5, 0.5, 1);
  const auto result = fusion.add(seen_from(pose, {{0.005, 0.005, 0}, {0.995, 0.505, 0}}), pose, 0);
  EXPECT_EQ(result.changed.count(), 2);
  EXPECT_TRUE(result.changed.tile(0, 0));
  EXPECT_TRUE(result.changed.tile(3, 1));
}

TEST(Fusion, ContinuesAKnownMap) {
  const OneCell world;
  HeightMap map(world.geometry);
  map.add(layer::elevation, 0.002F);
  FusionParameters p;
  p.change_rate = 0;
  HeightFusion fusion(map, p, 50);
  fusion.add(world.at(0.004), world.pose, 60);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.003, 1e-6);
  fusion.clear();
  EXPECT_EQ(count_known(fusion.map().layer(layer::elevation)), 0U);
  fusion.add(world.at(0.004), world.pose, 1);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.004, 1e-6);
}

TEST(Fusion, NamesABadParameter) {
  const GridGeometry g(0, 0, 1, 1, 1);
  const auto message = [&](const FusionParameters& p) {
    try {
      HeightFusion fusion(g, p);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  FusionParameters p;
  p.sensor.range_sigma = 0;
  EXPECT_NE(message(p).find("range_sigma"), std::string::npos);
  p = {};
  p.gate_sigma = -1;
  EXPECT_NE(message(p).find("gate_sigma"), std::string::npos);
  p = {};
  p.max_range = 0;
  EXPECT_NE(message(p).find("max_range"), std::string::npos);
  p = {};
  p.change_rate = std::nan("");
  EXPECT_NE(message(p).find("change_rate"), std::string::npos);

  HeightFusion fusion(g, {});
  EXPECT_THROW(fusion.add({}, Eigen::Isometry3d::Identity(), std::nan("")), Error);
  PointCloud uneven;
  uneven.x.push_back(1);
  EXPECT_THROW(fusion.add(uneven, Eigen::Isometry3d::Identity(), 0), Error);
}

}  // namespace
}  // namespace aeolian
