/// Change is signal: migrating ripples, still beds, beds that begin to move and that stop.
#include <cmath>

#include "fusion_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double wavelength = 0.1;
constexpr double amplitude = 0.0025;
constexpr double celerity = 0.03 / 60;
/// Of a normal distribution beyond the gate of four standard deviations: 6.3e-5.
constexpr double tail = 1.5e-4;

/// How a map follows a sinusoid over the last scans.
struct Following {
  double rmse = 0;
  double gain = 0;        ///< amplitude over the true one
  double chi2 = 0;        ///< mean of error^2 / stated variance
  double rate_rmse = 0;   ///< [m/s]
  double refused = 0;     ///< share of the points that were refused
  double worst_rmse = 0;  ///< of any scan after the bed began to move
};

struct Scene {
  double sigma = 0.001;
  double points_per_cell = 1;
  double interval = 1;
  int scans = 250;
  int scored = 80;
  double speed = celerity;
  double starts = 0;  ///< when the ripples begin to move [s]
  double stops = 1e9;
  std::uint64_t seed = 1;
};

/// Scans from straight above, far enough away that every ray is vertical.
Following follow(const Scene& run) {
  const GridGeometry g(0, 0, 0.002, 100, 64);
  FusionParameters p;
  p.sensor.range_sigma = run.sigma;
  p.change = HeightChange::of_ripples(celerity, wavelength, 2 * amplitude);
  HeightFusion fusion(g, p);
  const Eigen::Isometry3d pose = looking_down(0.1, 0.064, 50);
  Following result;
  double projected = 0;
  double norm = 0;
  std::size_t count = 0;
  double shift = 0;
  for (int scan = 0; scan < run.scans; ++scan) {
    const double stamp = scan * run.interval;
    const bool moves = stamp > run.starts && stamp <= run.stops;
    if (moves) shift += run.speed * run.interval;
    RandomStream random(run.seed, static_cast<std::uint64_t>(scan));
    PointCloud cloud;
    const auto points = static_cast<std::size_t>(run.points_per_cell * static_cast<double>(g.size()));
    for (std::size_t i = 0; i < points; ++i) {
      const CellIndex at = g.cell_at(i % g.size());
      const double x = g.x(at.x) + g.cell() * (random.uniform() - 0.5);
      const double y = g.y(at.y) + g.cell() * (random.uniform() - 0.5);
      const double z =
          amplitude * std::sin(2 * M_PI * (x - shift) / wavelength) + run.sigma * random.normal();
      cloud.push_back(static_cast<float>(x - 0.1), static_cast<float>(0.064 - y), static_cast<float>(-z));
    }
    cloud.origin_z = 50;
    result.refused += static_cast<double>(fusion.add(cloud, pose, stamp).outlier_cells) /
                      (static_cast<double>(cloud.size()) * run.scans);

    double squared = 0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double phase = 2 * M_PI * (g.x(g.cell_at(i).x) - shift) / wavelength;
      const double truth = amplitude * std::sin(phase);
      const double height = static_cast<double>(fusion.map().layer(layer::elevation)[i]);
      const double error = height - truth;
      squared += error * error;
      if (scan < run.scans - run.scored) continue;
      const double variance = static_cast<double>(fusion.map().layer(layer::variance)[i]);
      const double rate = -amplitude * std::cos(phase) * 2 * M_PI / wavelength * (moves ? run.speed : 0);
      const double rate_error = static_cast<double>(fusion.map().layer(layer::rate)[i]) - rate;
      result.chi2 += error * error / variance;
      result.rmse += error * error;
      result.rate_rmse += rate_error * rate_error;
      projected += height * std::sin(phase);
      norm += amplitude * std::sin(phase) * std::sin(phase);
      ++count;
    }
    if (stamp > run.starts && stamp > 60)
      result.worst_rmse = std::max(result.worst_rmse, std::sqrt(squared / static_cast<double>(g.size())));
  }
  const auto n = static_cast<double>(count);
  result.chi2 /= n;
  result.rmse = std::sqrt(result.rmse / n);
  result.rate_rmse = std::sqrt(result.rate_rmse / n);
  result.gain = projected / norm;
  const auto record = [](const char* name, double value) {
    testing::Test::RecordProperty(name, std::to_string(value));
  };
  record("rmse_mm", 1e3 * result.rmse);
  record("gain", result.gain);
  record("chi2", result.chi2);
  return result;
}

// 307 200 points on 0.5 m x 0.4 m in cells of 2 mm.
TEST(FusionTracking, FollowsMigratingRipplesUnderADepthCamera) {
  Scene run;
  run.points_per_cell = 6.1;
  const Following f = follow(run);
  EXPECT_LT(f.rmse, 0.0004);
  EXPECT_GT(f.gain, 0.97);
  EXPECT_LT(f.gain, 1.06);
  EXPECT_NEAR(f.chi2, 1, 0.1);
  EXPECT_LT(f.rate_rmse, 0.5 * 5.6e-5);
  EXPECT_LT(f.refused, tail);
}

TEST(FusionTracking, FollowsMigratingRipplesWithOnePointACell) {
  const Following f = follow({});
  EXPECT_LT(f.rmse, 0.0004);
  EXPECT_GT(f.gain, 0.97);
  EXPECT_NEAR(f.chi2, 1, 0.1);
  EXPECT_LT(f.refused, tail);
}

// Tripods of the demo: every ten seconds, 0.6 mm.
TEST(FusionTracking, DoesNotLagWhenCloudsComeRarely) {
  Scene run;
  run.sigma = 0.0006;
  run.interval = 10;
  run.scans = 120;
  run.scored = 60;
  const Following f = follow(run);
  EXPECT_LT(f.rmse, run.sigma);
  EXPECT_GT(f.gain, 0.97);
  EXPECT_NEAR(f.chi2, 1, 0.15);
  EXPECT_LT(f.refused, tail);
}

TEST(FusionTracking, AveragesOnWhileTheBedIsStill) {
  Scene run;
  run.speed = 0;
  run.scans = 400;
  run.scored = 1;
  const Following f = follow(run);
  EXPECT_LT(f.rmse, 1.2 * run.sigma / std::sqrt(400.0));
  EXPECT_NEAR(f.chi2, 1, 0.1);
}

TEST(FusionTracking, NoticesThatAStillBedBeginsToMove) {
  Scene run;
  run.starts = 200;
  run.scans = 340;
  run.scored = 60;
  const Following f = follow(run);
  EXPECT_LT(f.worst_rmse, 0.0006);
  EXPECT_LT(f.rmse, 0.0004);
  EXPECT_NEAR(f.chi2, 1, 0.1);
  EXPECT_LT(f.refused, tail);
}

TEST(FusionTracking, RestsAgainWhenTheBedStops) {
  Scene run;
  run.stops = 100;
  run.scans = 450;
  run.scored = 1;
  const Following f = follow(run);
  EXPECT_LT(f.rmse, 0.0001);
}

/// How a map takes to a still bed at 10 Hz, whose noise is so many times what it was told.
struct Rest {
  double recognised = 0;  ///< when most tiles gather scans [s]
  double told = 0;        ///< share of the tiles that are told of in a scan, in the second half
  double rmse = 0;        ///< in the end [noise of a point / root of the points of a cell]
};

Rest rest(double points_per_cell, double noise_factor, int scans) {
  const GridGeometry g(0, 0, 0.002, 96, 96);
  FusionParameters p;
  p.sensor.range_sigma = 0.0006;
  const double sigma = noise_factor * p.sensor.range_sigma;
  HeightFusion fusion(g, p);
  const Eigen::Isometry3d pose = looking_down(0.096, 0.096, 50);
  const auto points = static_cast<std::size_t>(points_per_cell * static_cast<double>(g.size()));
  Rest result;
  double told = 0;
  for (int scan = 0; scan < scans; ++scan) {
    RandomStream random(11, static_cast<std::uint64_t>(scan));
    PointCloud cloud;
    for (std::size_t i = 0; i < points; ++i)
      cloud.push_back(static_cast<float>(0.192 * random.uniform() - 0.096),
                      static_cast<float>(0.192 * random.uniform() - 0.096),
                      static_cast<float>(sigma * random.normal()));
    cloud.origin_z = 50;
    const int tiles = fusion.add(cloud, pose, 0.1 * scan).changed.count();
    if (result.recognised == 0 && tiles < 5) result.recognised = 0.1 * scan;
    if (scan >= scans / 2) told += tiles / 9.0;
  }
  result.told = told / (scans - scans / 2);
  double squared = 0;
  for (const float height : fusion.map().layer(layer::elevation))
    squared += static_cast<double>(height) * static_cast<double>(height);
  result.rmse = std::sqrt(squared / static_cast<double>(g.size()) * points_per_cell * scans) / sigma;
  testing::Test::RecordProperty("recognised_s", std::to_string(result.recognised));
  return result;
}

TEST(FusionRest, IsRecognisedInSeconds) {
  for (const double points_per_cell : {0.3, 1.0, 3.0}) {
    const Rest found = rest(points_per_cell, 1, 200);
    EXPECT_GT(found.recognised, 0) << points_per_cell;
    EXPECT_LT(found.recognised, 8) << points_per_cell;
    EXPECT_LT(found.told, 0.3) << points_per_cell;
    EXPECT_NEAR(found.rmse, 1, 0.1) << points_per_cell;
  }
}

// Had a tile been taken to move once, its cells would have begun anew and their error would be larger.
TEST(FusionRest, LastsWhenTheNoiseIsNotAsTold) {
  for (const double noise : {0.8, 1.2, 1.4}) {
    const Rest found = rest(3, noise, 200);
    EXPECT_LT(found.told, 0.3) << noise;
    EXPECT_NEAR(found.rmse, 1, 0.1) << noise;
  }
}

// Five times slower than the filter was told; some tiles pass for still between two looks.
TEST(FusionTracking, FollowsSlowRipplesToo) {
  Scene run;
  run.speed = celerity / 5;
  const Following f = follow(run);
  EXPECT_LT(f.rmse, 0.0004);
  EXPECT_GT(f.gain, 0.97);
  EXPECT_LT(f.chi2, 1.5);
}

}  // namespace
}  // namespace aeolian
