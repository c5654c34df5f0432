/// Points that are not of the bed: grains in flight, flying pixels, plants, stray echoes, dropouts.
#include <cmath>

#include "fusion_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double sigma = 0.001;

/// A still bed with ripples, seen from straight above with `points` a cell and scan of which a share flies
/// up to 5 cm above the bed, and another share is lost.
struct Saltation {
  GridGeometry geometry{0, 0, 0.002, 96, 96};
  Eigen::Isometry3d pose = looking_down(0.096, 0.096, 50);
  double points_per_cell = 2;
  double in_flight = 0.05;
  double lost = 0.1;

  static double bed(double x) { return 0.0025 * std::sin(2 * M_PI * x / 0.1); }
  PointCloud scan(std::uint64_t number) const {
    RandomStream random(3, number);
    PointCloud cloud;
    cloud.origin_z = 50;
    const auto count = static_cast<std::size_t>(points_per_cell * static_cast<double>(geometry.size()));
    for (std::size_t i = 0; i < count; ++i) {
      const double x = geometry.length_x() * random.uniform();
      const double y = geometry.length_y() * random.uniform();
      double z = bed(x) + sigma * random.normal();
      if (random.uniform() < in_flight) z += 0.05 * random.uniform();
      if (random.uniform() < lost) z = NAN;
      cloud.push_back(static_cast<float>(x - 0.096), static_cast<float>(0.096 - y), static_cast<float>(-z));
    }
    return cloud;
  }
};

struct Errors {
  double bias = 0;
  double rmse = 0;
  double worst = 0;
  std::size_t known = 0;
};

template <class Bed>
Errors errors(const HeightMap& map, Bed&& bed) {
  Errors e;
  const GridGeometry& g = map.geometry();
  for (std::size_t i = 0; i < g.size(); ++i) {
    const float height = map.layer(layer::elevation)[i];
    if (!std::isfinite(height)) continue;
    const double d = static_cast<double>(height) - bed(g.x(g.cell_at(i).x));
    e.bias += d;
    e.rmse += d * d;
    e.worst = std::max(e.worst, std::abs(d));
    ++e.known;
  }
  e.bias /= static_cast<double>(e.known);
  e.rmse = std::sqrt(e.rmse / static_cast<double>(e.known));
  return e;
}

class FusionSaltation : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(SharesInFlight, FusionSaltation, testing::Values(0.01, 0.03, 0.05));

TEST_P(FusionSaltation, DoesNotRaiseTheMap) {
  Saltation world;
  world.in_flight = GetParam();
  FusionParameters p;
  p.sensor.range_sigma = sigma;
  HeightFusion fusion(world.geometry, p);
  FusionParameters plain = p;
  plain.robust = false;
  HeightFusion naive(world.geometry, plain);
  for (std::uint64_t k = 0; k < 40; ++k) {
    const PointCloud cloud = world.scan(k);
    fusion.add(cloud, world.pose, static_cast<double>(k));
    naive.add(cloud, world.pose, static_cast<double>(k));
  }
  const Errors robust = errors(fusion.map(), Saltation::bed);
  EXPECT_EQ(robust.known, world.geometry.size());
  EXPECT_LT(std::abs(robust.bias), 0.00003);
  EXPECT_LT(robust.rmse, 0.0004);
  EXPECT_LT(robust.worst, 0.004);
  EXPECT_GT(errors(naive.map(), Saltation::bed).bias, 0.9 * 0.025 * GetParam());
}

// One point a cell: some cells see a grain first and must not take it for the bed for long.
TEST(FusionRobust, ACellThatSawAGrainFirstComesDownWithTheNextScan) {
  Saltation world;
  world.points_per_cell = 1;
  FusionParameters p;
  p.sensor.range_sigma = sigma;
  HeightFusion fusion(world.geometry, p);
  for (std::uint64_t k = 0; k < 8; ++k) fusion.add(world.scan(k), world.pose, static_cast<double>(k));
  const Errors e = errors(fusion.map(), Saltation::bed);
  EXPECT_LT(e.bias, 0.0001);
  EXPECT_LT(e.rmse, 0.0012);
}

// At the edge of a raised floe nearly a third of the pixels fly in between. They may fool a cell of the edge
// for some scans, as its first points, but hardly any.
TEST(FusionRobust, FlyingPixelsAtAnEdgeAreDropped) {
  const GridGeometry g(0, 0, 0.005, 80, 40);
  const auto floor = [](double x) { return x < 0.2 ? 0.0 : 0.08; };
  FusionParameters p;
  p.sensor.range_sigma = sigma;
  HeightFusion fusion(g, p);
  const Eigen::Isometry3d pose = looking_down(0.2, 0.1, 50);
  for (std::uint64_t k = 0; k < 20; ++k) {
    RandomStream random(5, k);
    PointCloud cloud;
    cloud.origin_z = 50;
    for (int i = 0; i < 20000; ++i) {
      const double x = 0.4 * random.uniform();
      const double y = 0.2 * random.uniform();
      const bool flies = std::abs(x - 0.2) < 0.01 && random.uniform() < 0.3;
      const double z = flies ? 0.08 * random.uniform() : floor(x) + sigma * random.normal();
      cloud.push_back(static_cast<float>(x - 0.2), static_cast<float>(0.1 - y), static_cast<float>(-z));
    }
    fusion.add(cloud, pose, static_cast<double>(k));
  }
  int edge = 0;
  int fooled = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double x = g.x(g.cell_at(i).x);
    const bool near_edge = std::abs(x - 0.2) < 0.01;
    const bool right =
        std::abs(static_cast<double>(fusion.map().layer(layer::elevation)[i]) - floor(x)) < 0.0025;
    EXPECT_TRUE(right || near_edge) << x;
    edge += near_edge ? 1 : 0;
    fooled += right ? 0 : 1;
  }
  EXPECT_LE(fooled, 0.02 * edge);
}

// A first scan with many points a cell, half of them plants above and a few stray echoes far below.
TEST(FusionRobust, TheLowerSurfaceOfAFirstScanIsTheBed) {
  const GridGeometry g(0, 0, 0.1, 20, 20);
  FusionParameters p;
  p.sensor.range_sigma = sigma;
  HeightFusion fusion(g, p);
  const Eigen::Isometry3d pose = looking_down(1, 1, 50);
  RandomStream random(11, 0);
  PointCloud cloud;
  cloud.origin_z = 50;
  for (int i = 0; i < 40000; ++i) {
    double z = sigma * random.normal();
    if (random.uniform() < 0.5) z = 0.1 + 0.3 * random.uniform();
    if (random.uniform() < 0.005) z = -1;
    cloud.push_back(static_cast<float>(2 * random.uniform() - 1),
                    static_cast<float>(2 * random.uniform() - 1), static_cast<float>(-z));
  }
  fusion.add(cloud, pose, 0);
  const Errors e = errors(fusion.map(), [](double) { return 0.0; });
  EXPECT_EQ(e.known, g.size());
  EXPECT_LT(std::abs(e.bias), 4 * sigma / std::sqrt(20000.0));
  EXPECT_NEAR(e.rmse, sigma / std::sqrt(50.0), 0.2 * sigma / std::sqrt(50.0));
}

TEST(FusionRobust, GrainsAtEverChangingHeightsDoNotReplaceTheBed) {
  const OneCell world;
  HeightFusion fusion(world.geometry, {});
  for (int k = 0; k < 5; ++k) fusion.add(world.at(0), world.pose, k);
  for (int k = 0; k < 8; ++k) fusion.add(world.at(0.01 + 0.02 * (k % 2)), world.pose, 5 + k);
  EXPECT_NEAR(fusion.map().layer(layer::elevation)[0], 0, 1e-5);
}

}  // namespace
}  // namespace aeolian
