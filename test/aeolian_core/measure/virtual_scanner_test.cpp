#include "aeolian_core/measure/virtual_scanner.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/measure/surface_rays.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// At (x, y, z), looking down and tilted by `tilt` towards +x.
Eigen::Isometry3d tripod(double x, double y, double z, double tilt) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  pose.linear() =
      (Eigen::AngleAxisd(-tilt, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return pose;
}

HeightMap level(const GridGeometry& g, float height) {
  HeightMap map(g);
  map.add(layer::elevation, height);
  return map;
}

double range(const PointCloud& c, std::size_t i) {
  return std::hypot(static_cast<double>(c.x[i]), static_cast<double>(c.y[i]), static_cast<double>(c.z[i]));
}

TEST(SurfaceRays, MeetsAPlaneWhereGeometrySays) {
  const GridGeometry g(-1, 2, 0.1, 20, 30);
  HeightMap::Layer heights(g.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const CellIndex c = g.cell_at(i);
    heights[i] = static_cast<float>(0.2 * g.x(c.x) - 0.1 * g.y(c.y));
  }
  const SurfaceRays surface(g, heights);
  RandomStream random(1, 0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d start(4 * random.uniform() - 2, 5 * random.uniform() + 1, 1 + random.uniform());
    const Eigen::Vector3d target(1.8 * random.uniform() - 0.9, 2.8 * random.uniform() + 2.1, 0);
    const Eigen::Vector3d foot(target.x(), target.y(), 0.2 * target.x() - 0.1 * target.y());
    const auto hit = surface.first_hit(start, foot - start);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance, 1, 1e-6);
    EXPECT_NEAR(hit->slope_x, 0.2, 1e-5);
    EXPECT_NEAR(hit->slope_y, -0.1, 1e-5);
    ++hits;
  }
  EXPECT_EQ(hits, 2000);
}

// No point of a ray before its hit lies below the surface, and the hit lies on it.
TEST(SurfaceRays, FindsTheFirstMeetingOnARoughSurface) {
  const GridGeometry g(0, 0, 0.01, 60, 60);
  HeightMap::Layer heights(g.size());
  RandomStream random(2, 0);
  for (float& h : heights) h = static_cast<float>(0.02 * random.uniform());
  const SurfaceRays surface(g, heights);
  const auto height_at = [&](const Eigen::Vector3d& p) {
    const double u = std::clamp(p.x() / 0.01 - 0.5, 0.0, 58.999999);
    const double v = std::clamp(p.y() / 0.01 - 0.5, 0.0, 58.999999);
    const int i = static_cast<int>(u);
    const int j = static_cast<int>(v);
    const auto h = [&](int a, int b) { return static_cast<double>(heights[g.index(i + a, j + b)]); };
    return (1 - u + i) * ((1 - v + j) * h(0, 0) + (v - j) * h(0, 1)) +
           (u - i) * ((1 - v + j) * h(1, 0) + (v - j) * h(1, 1));
  };
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d start(random.uniform() * 0.6, random.uniform() * 0.6,
                                0.03 + 0.1 * random.uniform());
    const Eigen::Vector3d target(0.1 + random.uniform() * 0.4, 0.1 + random.uniform() * 0.4, 0);
    const Eigen::Vector3d ray = target - start;
    const auto hit = surface.first_hit(start, ray);
    ASSERT_TRUE(hit.has_value());
    const Eigen::Vector3d at = start + hit->distance * ray;
    EXPECT_NEAR(at.z(), height_at(at), 1e-9);
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector3d before = start + hit->distance * k / 200.0 * ray;
      ASSERT_GT(before.z() + 1e-9, height_at(before));
    }
  }
}

TEST(VirtualScanner, RangesToALevelBedAreAnalytic) {
  VirtualScanner scanner;
  scanner.pose = tripod(0, 0, 1.2, 0);
  scanner.columns = 41;
  scanner.rows = 31;
  scanner.range_sigma = 0;
  scanner.dropout = 0;
  const auto cloud = scanner.scan(level(GridGeometry(-2, -2, 0.01, 400, 400), 0.05F), 1, 0);
  ASSERT_EQ(cloud.size(), 41U * 31U);
  for (int r = 0; r < 31; ++r)
    for (int c = 0; c < 41; ++c) {
      const auto i = static_cast<std::size_t>(r * 41 + c);
      EXPECT_NEAR(cloud.z[i], 1.15, 1e-6);
      const double a = ((c + 0.5) / 41 - 0.5) * scanner.field_of_view_x;
      const double b = ((r + 0.5) / 31 - 0.5) * scanner.field_of_view_y;
      EXPECT_NEAR(std::atan2(cloud.x[i], cloud.z[i]), a, 0.501 * scanner.field_of_view_x / 41);
      EXPECT_NEAR(std::asin(static_cast<double>(cloud.y[i]) / range(cloud, i)), b,
                  0.501 * scanner.field_of_view_y / 31);
    }
}

// Fixed directions would pass over the same ground each time: most cells must be seen within ten sparse
// scans.
TEST(VirtualScanner, SweepsStartAtDifferentPhases) {
  VirtualScanner scanner;
  scanner.pose = tripod(0, 0, 1, 0);
  scanner.columns = 50;
  scanner.rows = 50;
  scanner.field_of_view_x = scanner.field_of_view_y = 0.5;
  scanner.dropout = 0;
  const GridGeometry g(-0.2, -0.2, 0.004, 100, 100);
  std::vector<bool> seen(g.size());
  for (std::uint64_t k = 0; k < 10; ++k) {
    const auto cloud = scanner.scan(level(g, 0), 1, k);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (const auto cell = g.find(cloud.x[i], -cloud.y[i])) seen[g.index(*cell)] = true;
  }
  EXPECT_GT(std::count(seen.begin(), seen.end(), true), 0.75 * static_cast<double>(g.size()));
}

// A wall 5 cm high across the view: behind it nothing is seen for height * distance / (tripod height - wall
// height).
TEST(VirtualScanner, CrestsHideWhatLiesBehind) {
  const GridGeometry g(0, 0, 0.002, 1000, 50);
  HeightMap map = level(g, 0);
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 495; ix < 505; ++ix) map.layer(layer::elevation)[g.index(ix, iy)] = 0.05F;
  VirtualScanner scanner;
  scanner.pose = tripod(0, 0.05, 0.5, 0.9);
  scanner.columns = 4000;
  scanner.rows = 1;
  scanner.field_of_view_x = 1.4;
  scanner.range_sigma = 0;
  scanner.dropout = 0;
  const auto cloud = scanner.scan(map, 1, 0);
  double behind = 10;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!std::isfinite(cloud.x[i])) continue;
    const Eigen::Vector3d p = scanner.pose * Eigen::Vector3d(cloud.x[i], cloud.y[i], cloud.z[i]);
    if (p.x() > 1.012) behind = std::min(behind, p.x());
  }
  const double brink = g.x(504);
  EXPECT_NEAR(behind, brink + 0.05 * brink / (0.5 - 0.05), 0.002);
}

TEST(VirtualScanner, NoiseAndDropoutAreAsStated) {
  VirtualScanner scanner;
  scanner.pose = tripod(0, 0, 1.2, 0);
  scanner.range_sigma = 0.002;
  scanner.dropout = 0.1;
  const HeightMap map = level(GridGeometry(-2, -2, 0.02, 200, 200), 0);
  const auto noisy = scanner.scan(map, 4, 0);
  VirtualScanner exact = scanner;
  exact.range_sigma = 0;
  exact.dropout = 0;
  const auto clean = exact.scan(map, 4, 0);
  double sum = 0;
  double squares = 0;
  double n = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    if (!std::isfinite(noisy.x[i])) continue;
    const double d = range(noisy, i) - range(clean, i);
    sum += d;
    squares += d * d;
    ++n;
  }
  const auto rays = static_cast<double>(noisy.size());
  EXPECT_NEAR(1 - n / rays, 0.1, 4 * std::sqrt(0.1 * 0.9 / rays));
  EXPECT_NEAR(sum / n, 0, 4 * 0.002 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.002, 4 * 0.002 / std::sqrt(2 * n));
}

TEST(VirtualScanner, IsDecidedBySeedAndScan) {
  VirtualScanner scanner;
  scanner.pose = tripod(0, 0, 1.2, 0);
  scanner.columns = 50;
  scanner.rows = 20;
  scanner.dropout = 0;
  const HeightMap map = level(GridGeometry(-2, -2, 0.02, 200, 200), 0);
  EXPECT_EQ(scanner.scan(map, 1, 2).z, scanner.scan(map, 1, 2).z);
  EXPECT_NE(scanner.scan(map, 1, 2).z, scanner.scan(map, 1, 3).z);
  EXPECT_NE(scanner.scan(map, 1, 2).z, scanner.scan(map, 2, 2).z);
}

TEST(VirtualScanner, SeesNothingOfUnknownGroundOrBesideTheMap) {
  VirtualScanner scanner;
  scanner.pose = tripod(0, 0, 1.2, 0);
  scanner.dropout = 0;
  const auto unknown = scanner.scan(level(GridGeometry(-2, -2, 0.02, 200, 200), HeightMap::unknown), 1, 0);
  EXPECT_EQ(count_known(unknown.x), 0U);
  const auto beside = scanner.scan(level(GridGeometry(3, 3, 0.02, 50, 50), 0), 1, 0);
  EXPECT_EQ(count_known(beside.x), 0U);
  scanner.pose = tripod(0, 0, -1, 0);
  EXPECT_EQ(count_known(scanner.scan(level(GridGeometry(-2, -2, 0.02, 200, 200), 0), 1, 0).x), 0U);
  scanner.dropout = 2;
  EXPECT_THROW(scanner.scan(level(GridGeometry(0, 0, 1, 1, 1), 0), 1, 0), Error);
}

}  // namespace
}  // namespace aeolian
