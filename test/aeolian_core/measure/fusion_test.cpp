#include "aeolian_core/measure/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../error_of.hpp"
#include "fusion_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

// Rays at all slants onto a noisy plane: bias within its own standard error, stated variance right by
// chi-square.
TEST(Fusion, StatesItsErrorRightly) {
  FusionParameters p;
  p.sensor.range_sigma = 0.001;
  p.change.rate_sigma = 0;
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
  RecordProperty("chi2", std::to_string(chi2 / cells));
  EXPECT_NEAR(chi2 / cells, 1, 0.1);
  EXPECT_LT(std::abs(weighted_error / weight), 4 / std::sqrt(weight));
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
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0, fixed::step);

  // An inlier between two outliers starts the count anew.
  fusion.add(world.at(0), world.pose, 6);
  EXPECT_EQ(fusion.add(world.at(0.05), world.pose, 7).outlier_cells, 1U);
  EXPECT_EQ(fusion.add(world.at(0.05), world.pose, 8).outlier_cells, 1U);
  result = fusion.add(world.at(0.05), world.pose, 9);
  EXPECT_EQ(result.outlier_cells, 0U);
  EXPECT_EQ(result.changed.count(), 1);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.05, fixed::step);
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], 1e-6, 1e-10);
}

TEST(Fusion, CountsWhatItCannotUse) {
  const GridGeometry g(0, 0, 0.1, 10, 10);
  FusionParameters p;
  p.sensor.min_range = 0.1;
  p.sensor.max_range = 5;
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

  p.sensor.min_range = 0;
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
    EXPECT_NEAR(fusion.map().layer(layer::elevation)[i], 100 - 0.001 * static_cast<double>(i % 7), 2e-5);
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
  HeightFusion fusion(world.geometry, p);
  fusion.add(world.at(0.01), world.pose, 1000);
  const float variance = fusion.map().layer(layer::variance)[0];
  const float elevation = fusion.map().layer(layer::elevation)[0];

  fusion.add(PointCloud{}, world.pose, 10);
  EXPECT_EQ(fusion.map().layer(layer::elevation)[0], elevation);
  EXPECT_EQ(fusion.map().layer(layer::variance)[0], variance);

  // Four seconds later by the new clock: what the bed may have done in these is in the prediction.
  fusion.add(world.at(0.011), world.pose, 14);
  const HeightStep step = height_step(p.change, 4);
  const double rate_variance = p.change.rate_sigma * p.change.rate_sigma;
  const double predicted = static_cast<double>(variance) + step.height_variance +
                           step.height_per_rate * step.height_per_rate * rate_variance;
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], predicted * 1e-6 / (predicted + 1e-6), 1e-10);
}

TEST(Fusion, TakesALateCloudAtTheTimeThatTheMapHasReached) {
  const OneCell world;
  HeightFusion late(world.geometry, {});
  late.add(world.at(0.010), world.pose, 100);
  late.add(world.at(0.010), world.pose, 101);
  late.add(world.at(0.011), world.pose, 100.5);
  HeightFusion in_time(world.geometry, {});
  in_time.add(world.at(0.010), world.pose, 100);
  in_time.add(world.at(0.010), world.pose, 101);
  in_time.add(world.at(0.011), world.pose, 101);
  EXPECT_NEAR(late.map().layer(layer::elevation)[0], in_time.map().layer(layer::elevation)[0], fixed::step);
  EXPECT_NEAR(late.map().layer(layer::variance)[0], in_time.map().layer(layer::variance)[0], 1e-11);
}

TEST(Fusion, TakesTwoCloudsOfOneStampAsOneSurface) {
  const OneCell world;
  FusionParameters p;
  p.change.rate_sigma = 1;
  HeightFusion fusion(world.geometry, p);
  fusion.add(world.at(0.000), world.pose, 3);
  fusion.add(world.at(0.001), world.pose, 3);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.0005, fixed::step);
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
  p.change.rate_sigma = 0;
  HeightFusion fusion(map, p, 50);
  fusion.add(world.at(0.004), world.pose, 60);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.003, fixed::step);
  fusion.clear();
  EXPECT_EQ(count_known(fusion.map().layer(layer::elevation)), 0U);
  fusion.add(world.at(0.004), world.pose, 1);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.004, fixed::step);
}

TEST(Fusion, SurvivesAbsurdPointsAndEmptyClouds) {
  const GridGeometry g(0, 0, 0.01, 50, 50);
  HeightFusion fusion(g, {});
  const Eigen::Isometry3d pose = looking_down(0.25, 0.25, 1);
  fusion.add(seen_from(pose, level_points(g, 0.01)), pose, 0);
  const HeightMap::Layer before = fusion.map().layer(layer::elevation);

  EXPECT_EQ(fusion.add({}, pose, 1).used, 0U);
  const float huge = std::numeric_limits<float>::max();
  const float tiny = std::numeric_limits<float>::denorm_min();
  PointCloud absurd;
  for (const float x : {huge, -huge, 1e30F, 1e20F, tiny, 0.0F})
    for (const float z : {huge, -huge, 9e3F, -9e3F, tiny}) absurd.push_back(x, 0, z);
  FusionResult result = fusion.add(absurd, pose, 2);
  EXPECT_EQ(result.used + result.not_finite + result.out_of_range + result.outside, absurd.size());
  for (std::size_t i = 0; i < g.size(); ++i)
    EXPECT_NEAR(fusion.map().layer(layer::elevation)[i], before[i], fixed::step);
  for (const float v : fusion.map().layer(layer::variance)) EXPECT_TRUE(v > 0 && v < 1);
}

TEST(Fusion, TakesTenMillionPointsAtOnce) {
  const GridGeometry g(0, 0, 0.1, 3, 3);
  FusionParameters p;
  HeightFusion fusion(g, p);
  const Eigen::Isometry3d pose = looking_down(0.15, 0.15, 1);
  fusion.add(seen_from(pose, level_points(g, 0)), pose, 0);
  RandomStream random(1, 0);
  PointCloud cloud;
  constexpr std::size_t count = 10000000;
  cloud.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto z = static_cast<float>(1 + 0.002 * (random.uniform() - 0.5));
    cloud.push_back(0.01F * static_cast<float>(i % 7), 0.01F * static_cast<float>(i % 5), z);
  }
  EXPECT_EQ(fusion.add(cloud, pose, 1).used, count);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[4], 0, 1e-5);
}

TEST(Fusion, FollowsAStampThatJumpsFarAheadAndBack) {
  const OneCell world;
  HeightFusion fusion(world.geometry, {});
  for (const double stamp : {0.0, 1.0, 1e10, 1e10 + 1, -1e10, 0.0, 1.0})
    fusion.add(world.at(0.01), world.pose, stamp);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0.01, 2 * fixed::step);
  EXPECT_LT(fusion.map().layer(layer::variance)[0], 1.01e-6);
}

TEST(Fusion, TakesTheBiasOffAndAnotherSensorsNoise) {
  const OneCell world;
  HeightFusion fusion(world.geometry, {});
  SensorNoise other;
  other.range_sigma = 0.002;
  other.range_bias = 0.05;
  fusion.add(world.at(-0.05), world.pose, 0, other);  // seen 5 cm too far away
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0, fixed::step);
  EXPECT_NEAR(fusion.map().layer(layer::variance)[0], 4e-6, 1e-9);
}

TEST(Fusion, CountsThePointsOfACell) {
  const OneCell world;
  HeightFusion fusion(world.geometry, {});
  EXPECT_TRUE(std::isnan(fusion.counts()[0]));
  fusion.add(world.at(0), world.pose, 0);
  EXPECT_EQ(fusion.counts()[0], 1);
  fusion.add(world.at(0), world.pose, 0);
  fusion.add(world.at(0), world.pose, 1);
  fusion.add(world.at(0.2), world.pose, 2);
  EXPECT_EQ(fusion.counts()[0], 3);
}

TEST(Fusion, NamesABadParameter) {
  const GridGeometry g(0, 0, 1, 1, 1);
  const auto message = [&](const FusionParameters& p) { return error_of([&] { HeightFusion(g, p); }); };
  FusionParameters p;
  p.sensor.range_sigma = 0;
  EXPECT_NE(message(p).find("range_sigma"), std::string::npos);
  p = {};
  p.gate_sigma = -1;
  EXPECT_NE(message(p).find("gate_sigma"), std::string::npos);
  p = {};
  p.sensor.max_range = 0;
  EXPECT_NE(message(p).find("max_range"), std::string::npos);
  p = {};
  p.change.rate_sigma = std::nan("");
  EXPECT_NE(message(p).find("rate_sigma"), std::string::npos);
  p = {};
  p.change.rate_time = 0;
  EXPECT_NE(message(p).find("rate_time"), std::string::npos);

  HeightFusion fusion(g, {});
  EXPECT_THROW(fusion.add({}, Eigen::Isometry3d::Identity(), std::nan("")), Error);
  PointCloud uneven;
  uneven.x.push_back(1);
  EXPECT_THROW(fusion.add(uneven, Eigen::Isometry3d::Identity(), 0), Error);
}

}  // namespace
}  // namespace aeolian
