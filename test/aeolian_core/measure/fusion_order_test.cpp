/// The map is the same to the bit whatever the order, the chunks, the threads and when it is read.
#include <algorithm>
#include <cstring>

#include "fusion_worlds.hpp"
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const std::vector<std::string> layers{layer::elevation, layer::variance, layer::rate, layer::rate_variance};

/// Scans of a moving bed with grains in flight, flying pixels and holes, in the sensor's frame.
class FusionOrder : public testing::Test {
 protected:
  static PointCloud scan(std::uint64_t number) {
    RandomStream random(7, number);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 80000; ++i) {
      const double x = 1.02 * random.uniform() - 0.01;
      double z = 0.003 * std::sin(60 * (x - 0.002 * static_cast<double>(number))) + 0.001 * random.normal();
      if (random.uniform() < 0.03) z += 0.05 * random.uniform();
      if (random.uniform() < 0.001) z = 3 * random.uniform() - 2;
      points.emplace_back(x, 1.02 * random.uniform() - 0.01, z);
    }
    return seen_from(pose(), points);
  }
  static Eigen::Isometry3d pose() {
    return looking_down(0.4, 0.5, 1.5) * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY());
  }
  static PointCloud part(const PointCloud& cloud, std::size_t from, std::size_t to) {
    PointCloud result;
    for (std::size_t i = from; i < to; ++i) result.push_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    return result;
  }

  /// Adds scans 0 to 7 with `add(fusion, cloud, stamp)`.
  template <class Add>
  HeightMap map(Add&& add) const {
    FusionParameters p;
    p.sensor.range_sigma_per_metre = 2e-4;
    p.sensor.angular_sigma = 1e-4;
    HeightFusion fusion(GridGeometry(0, 0, 0.01, 100, 90), p);
    for (std::uint64_t k = 0; k < 8; ++k) add(fusion, scan(k), 0.7 * static_cast<double>(k));
    return fusion.map();
  }
  HeightMap whole() const {
    return map([](HeightFusion& fusion, const PointCloud& cloud, double stamp) {
      fusion.add(cloud, pose(), stamp);
    });
  }
  static void expect_same_bits(const HeightMap& a, const HeightMap& b) {
    for (const std::string& name : layers) {
      const auto& x = a.layer(name);
      const auto& y = b.layer(name);
      EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(float)), 0) << name;
    }
  }
};

TEST_F(FusionOrder, OfPoints) {
  expect_same_bits(whole(), map([](HeightFusion& fusion, PointCloud cloud, double stamp) {
                     for (auto* values : {&cloud.x, &cloud.y, &cloud.z})
                       std::reverse(values->begin(), values->end());
                     fusion.add(cloud, pose(), stamp);
                   }));
}

TEST_F(FusionOrder, OfChunks) {
  expect_same_bits(whole(), map([](HeightFusion& fusion, const PointCloud& cloud, double stamp) {
                     for (std::size_t from = 0; from < cloud.size(); from += 7777)
                       fusion.add(part(cloud, from, std::min(from + 7777, cloud.size())), pose(), stamp);
                   }));
}

TEST_F(FusionOrder, OfReading) {
  expect_same_bits(whole(), map([](HeightFusion& fusion, const PointCloud& cloud, double stamp) {
                     const FusionResult result = fusion.add(cloud, pose(), stamp);
                     stamp < 3 ? fusion.map() : fusion.map(result.changed);
                   }));
}

/// Rows of cells wait while others are seen, and the bed begins to move and comes to rest again.
TEST_F(FusionOrder, OfChunksOfBandsOfABedThatRestsAndMoves) {
  const auto map = [&](std::size_t chunk) {
    HeightFusion fusion(GridGeometry(0, 0, 0.01, 64, 64), FusionParameters());
    double crest = 0;
    for (std::uint64_t k = 0; k < 60; ++k) {
      if (k > 20 && k < 40) crest += 0.004;
      RandomStream random(8, k);
      const double from = k % 3 == 0 ? 0 : 0.6 * random.uniform();
      std::vector<Eigen::Vector3d> points;
      for (int i = 0; i < 6000; ++i) {
        const double x = 0.64 * random.uniform();
        points.emplace_back(x, from + (0.64 - from) * i / 6000,
                            0.003 * std::sin(60 * (x - crest)) + 0.001 * random.normal());
      }
      const PointCloud cloud = seen_from(pose(), points);
      for (std::size_t at = 0; at < cloud.size(); at += chunk)
        fusion.add(part(cloud, at, std::min(at + chunk, cloud.size())), pose(), 1.0 * static_cast<double>(k));
    }
    return fusion.map();
  };
  expect_same_bits(map(6000), map(700));
}

/// At 10 Hz a still tile takes several scans together; sometimes a grain flies; then ripples begin to
/// migrate.
TEST_F(FusionOrder, OfChunksAndReadingOfQuickScansOfABedThatRestsAndMoves) {
  constexpr int still_scans = 300;
  constexpr int moving_scans = 200;
  constexpr double deposition = 6e-5;  // [m/s]
  const auto bed = [](double x, double time) {
    return 0.0005 * std::sin(60 * x) + deposition * std::max(0.0, time - 0.1 * still_scans);
  };
  const GridGeometry geometry(0, 0, 0.01, 64, 64);
  int tiles_written = 0;  // in the last five seconds of rest
  const auto map = [&](std::size_t chunk, bool read = false) {
    HeightFusion fusion(geometry, FusionParameters());
    tiles_written = 0;
    for (int k = 0; k < still_scans + moving_scans; ++k) {
      const double time = 0.1 * k;
      RandomStream random(9, static_cast<std::uint64_t>(k));
      std::vector<Eigen::Vector3d> points;
      for (int i = 0; i < 1500; ++i) {
        const double x = 0.64 * random.uniform();
        const bool flies = k % 7 == 0 && i % 500 == 0;
        points.emplace_back(x, 0.64 * random.uniform(),
                            bed(x, time) + 0.0008 * random.normal() + (flies ? 0.03 : 0));
      }
      const PointCloud cloud = seen_from(pose(), points);
      for (std::size_t at = 0; at < cloud.size(); at += chunk) {
        const FusionResult result =
            fusion.add(part(cloud, at, std::min(at + chunk, cloud.size())), pose(), time);
        if (read && k % 3 == 0) fusion.map();
        if (read && k % 3 == 1) fusion.map(result.changed);
        if (k >= still_scans - 50 && k < still_scans) tiles_written += result.changed.count();
      }
    }
    return fusion.map();
  };
  const HeightMap at_once = map(1500);
  EXPECT_LT(tiles_written, 50 * 4 / 2);
  expect_same_bits(at_once, map(200));
  expect_same_bits(at_once, map(1500, /*read=*/true));

  double squares = 0;
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const double truth = bed(geometry.x(geometry.cell_at(i).x), 0.1 * (still_scans + moving_scans - 1));
    const double error = static_cast<double>(at_once.layer(layer::elevation)[i]) - truth;
    squares += error * error;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(geometry.size())), 0.0004) << "1.2 mm have fallen";
}

/// A still bed of 2 x 2 tiles, seen at 10 Hz but for the last column of cells.
class FusionOfAStillBed : public FusionOrder {
 protected:
  static constexpr double seen_to = 0.63;  // [m], of 0.64
  static PointCloud scan_of(int k, double from, double to) {
    RandomStream random(10, static_cast<std::uint64_t>(k));
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 4000; ++i)
      points.emplace_back(from + (to - from) * random.uniform(), 0.64 * random.uniform(),
                          0.0008 * random.normal());
    return seen_from(pose(), points);
  }
  static FusionResult add(HeightFusion& to, int k) { return to.add(scan_of(k, 0, seen_to), pose(), 0.1 * k); }
  HeightFusion fusion{GridGeometry(0, 0, 0.01, 64, 64), FusionParameters()};
};

TEST_F(FusionOfAStillBed, IsTheSameWheneverItWasRead) {
  HeightFusion unread(GridGeometry(0, 0, 0.01, 64, 64), FusionParameters());
  HeightFusion read_now_and_then(GridGeometry(0, 0, 0.01, 64, 64), FusionParameters());
  const int last = 150;
  for (int k = 0; k < last; ++k) {
    add(unread, k);
    add(read_now_and_then, k);
    if (k % 13 == 0) read_now_and_then.map();
    const FusionResult result = add(fusion, k);
    if (k % 2 == 0) fusion.map(result.changed);
    if (k < last - 15) continue;
    expect_same_bits(fusion.map(), read_now_and_then.map());
  }
  expect_same_bits(fusion.map(), unread.map());
}

TEST_F(FusionOfAStillBed, ShowsNewCellsAtOnce) {
  int k = 0;
  while (add(fusion, k).changed.count() > 0 || k < 100) ++k;
  const std::size_t known = count_known(fusion.map().layer(layer::elevation));
  const FusionResult result = fusion.add(scan_of(k + 1, seen_to, 0.64), pose(), 0.1 * (k + 1));
  EXPECT_EQ(result.changed.count(), 2);
  EXPECT_EQ(count_known(fusion.map(result.changed).layer(layer::elevation)), known + 64);
}

TEST_F(FusionOrder, OfThreads) {
  HeightMap one;
  tbb::task_arena(1).execute([&] { one = whole(); });
  HeightMap two;
  tbb::task_arena(2).execute([&] { two = whole(); });
  expect_same_bits(one, two);
}

/// A cell that was seen less often than its neighbour goes on as if it were alone, whatever both intervals
/// are.
TEST(FusionOfCells, GoOnOverTheirOwnIntervals) {
  const Eigen::Isometry3d pose = looking_down(0.05, 0.05, 1.5);
  const auto seen_at = [&](std::initializer_list<double> places) {
    std::vector<Eigen::Vector3d> points;
    for (const double x : places) points.emplace_back(x, 0.045, 0.001);
    return seen_from(pose, points);
  };
  const auto fused = [&](const std::vector<std::pair<double, std::initializer_list<double>>>& scans) {
    HeightFusion fusion(GridGeometry(0, 0, 0.01, 10, 10), {});
    for (const auto& [stamp, places] : scans) fusion.add(seen_at(places), pose, stamp);
    return HeightMap(fusion.map());
  };
  constexpr double often = 0.025, rarely = 0.035;
  for (int interval = 1; interval <= 400; ++interval) {
    const double between = 1e-3 * interval;
    const HeightMap both = fused({{0, {often, rarely}}, {between, {often}}, {1, {often, rarely}}});
    const HeightMap one = fused({{0, {often}}, {between, {often}}, {1, {often}}});
    const HeightMap other = fused({{0, {rarely}}, {1, {rarely}}});
    for (const std::string& name : layers) {
      EXPECT_EQ(both.layer(name)[42], one.layer(name)[42]) << name << ", " << interval << " ms";
      EXPECT_EQ(both.layer(name)[43], other.layer(name)[43]) << name << ", " << interval << " ms";
    }
  }
}

}  // namespace
}  // namespace aeolian
