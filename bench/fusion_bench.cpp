// Fusing one cloud of a depth camera (640 x 480) into a map of 1000 x 1000 cells.
// `times_copy`: how many times as long as copying the cloud's bytes, the least that any reader of the cloud
// must do.

#include <cmath>
#include <cstring>
#include <ctime>

#include <benchmark/benchmark.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/surface/random.hpp"

namespace {

using aeolian::GridGeometry;
using aeolian::HeightFusion;
using aeolian::PointCloud;

/// What a depth camera 1.2 m over the middle of a rough level bed sees of 2 m x 1.5 m.
PointCloud depth_image(int width, int height) {
  aeolian::RandomStream random(1, 0);
  PointCloud cloud;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double z = 1.2 + 0.0006 * random.normal();
      cloud.push_back(static_cast<float>(z / 1.2 * 2.0 * ((u + 0.5) / width - 0.5)),
                      static_cast<float>(z / 1.2 * 1.5 * ((v + 0.5) / height - 0.5)), static_cast<float>(z));
    }
  return cloud;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds_to_copy(const PointCloud& cloud) {
  PointCloud copy = cloud;
  const auto copy_once = [&] {
    for (const auto& [to, from] : {std::pair(&copy.x, &cloud.x), {&copy.y, &cloud.y}, {&copy.z, &cloud.z}})
      std::memcpy(to->data(), from->data(), from->size() * sizeof(float));
    benchmark::ClobberMemory();
  };
  constexpr int times = 200;
  const double start = processor_seconds();
  for (int i = 0; i < times; ++i) copy_once();
  return (processor_seconds() - start) / times;
}

void fuse(benchmark::State& state, double cell, int nx, int ny) {
  const GridGeometry geometry(-0.5 * nx * cell, -0.5 * ny * cell, cell, nx, ny);
  const PointCloud cloud = depth_image(640, 480);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 1.2;
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  HeightFusion fusion(geometry, {});
  const double copy = seconds_to_copy(cloud);
  double stamp = 0;
  const double start = processor_seconds();
  for (auto _ : state) benchmark::DoNotOptimize(fusion.add(cloud, pose, stamp += 0.1));
  const double elapsed = processor_seconds() - start;
  const auto clouds = static_cast<double>(state.iterations());
  state.counters["points_per_s"] = static_cast<double>(cloud.size()) * clouds / elapsed;
  state.counters["times_copy"] = elapsed / clouds / copy;
}

void BM_OnePointPerCell(benchmark::State& state) { fuse(state, 0.002, 1000, 1000); }
void BM_ManyPointsPerCell(benchmark::State& state) { fuse(state, 0.01, 200, 150); }
BENCHMARK(BM_OnePointPerCell)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ManyPointsPerCell)->Unit(benchmark::kMillisecond);

}  // namespace
