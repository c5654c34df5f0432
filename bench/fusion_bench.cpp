// Fusing clouds into a map of 1000 x 1000 cells of 2 mm: transform, noise model, gate, height, rate and their
// variances. The first argument is the number of threads.
//
// `of_bandwidth`: the time that memory needs, at the speed of a plain copy measured here, for what a cloud
// makes the fusion read and write (points, samples, one line of the cache and 16 bytes of layers per cell
// touched), over the time taken.

#include <chrono>
#include <cmath>

#include "copy_speed.hpp"
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/surface/random.hpp"

namespace {

using aeolian::GridGeometry;
using aeolian::HeightFusion;
using aeolian::PointCloud;
using Clock = std::chrono::steady_clock;

constexpr double height_of_sensor = 1.2;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What a depth camera over the middle of a rough level bed sees of width x 3/4 width [m]. The pixels are the
/// same in each image; the noise is not.
PointCloud depth_image(double width, std::uint64_t number) {
  aeolian::RandomStream random(1, number);
  PointCloud cloud;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const double z = height_of_sensor + 0.0006 * random.normal();
      const double scale = z / height_of_sensor * width;
      cloud.push_back(static_cast<float>(scale * ((u + 0.5) / 640 - 0.5)),
                      static_cast<float>(scale * 0.75 * ((v + 0.5) / 480 - 0.5)), static_cast<float>(z));
    }
  return cloud;
}

/// Points anywhere in the map, in no order.
PointCloud random_points(std::size_t count, std::uint64_t number) {
  aeolian::RandomStream random(2, number);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i)
    cloud.push_back(static_cast<float>(2 * random.uniform() - 1),
                    static_cast<float>(2 * random.uniform() - 1),
                    static_cast<float>(height_of_sensor + 0.0006 * random.normal()));
  return cloud;
}

/// `interval` [s] from cloud to cloud: of quick ones, a still bed gathers some.
void fuse(benchmark::State& state, const std::vector<PointCloud>& clouds, double interval = 1,
          bool read = false) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const GridGeometry geometry(-1, -1, 0.002, 1000, 1000);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = height_of_sensor;
  pose.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  aeolian::FusionParameters parameters;
  parameters.sensor.range_sigma = 0.0006;
  HeightFusion fusion(geometry, parameters);
  std::size_t number = 0;
  const auto add = [&] {
    ++number;
    const auto stamp = interval * static_cast<double>(number);
    const aeolian::FusionResult result = fusion.add(clouds[number % clouds.size()], pose, stamp);
    if (read) benchmark::DoNotOptimize(fusion.map(result.changed));
    return result;
  };
  for (int i = 0; i < 10; ++i) add();  // cells that are not known yet take longer, once
  double quickest = 1e9;
  for (auto _ : state) {
    const auto start = Clock::now();
    benchmark::DoNotOptimize(add());
    quickest = std::min(quickest, seconds_since(start));
  }
  const auto points = static_cast<double>(clouds[0].size());
  const auto cells = static_cast<double>(aeolian::count_known(fusion.map().layer(aeolian::layer::elevation)));
  const double touched = cells * -std::expm1(-points / cells);
  const double bytes = points * (12 + 2 * 8) + touched * (64 + 16);
  state.counters["ms_quickest"] = 1e3 * quickest;
  state.counters["points/s"] = benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["of_bandwidth"] = bytes * aeolian::bench::seconds_to_copy_a_byte() / quickest;
}

void BM_DepthImageOverTheMap(benchmark::State& state) { fuse(state, {depth_image(2, 0), depth_image(2, 1)}); }
void BM_DepthImageOverTheMapThatIsRead(benchmark::State& state) {
  fuse(state, {depth_image(2, 0), depth_image(2, 1)}, 1, true);
}
void BM_DepthImageOverTheMapAt10Hz(benchmark::State& state) {
  fuse(state, {depth_image(2, 0), depth_image(2, 1)}, 0.1, true);
}
void BM_DepthImageOfAPart(benchmark::State& state) {
  fuse(state, {depth_image(0.8, 0), depth_image(0.8, 1)});
}
void BM_MillionRandomPoints(benchmark::State& state) {
  fuse(state, {random_points(1000000, 0), random_points(1000000, 1)});
}
BENCHMARK(BM_DepthImageOverTheMap)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BM_DepthImageOverTheMapThatIsRead)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BM_DepthImageOverTheMapAt10Hz)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BM_DepthImageOfAPart)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BM_MillionRandomPoints)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
