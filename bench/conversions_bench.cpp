// Between messages and core types: a depth image as PointCloud2, a map of four layers as GridMap.
//
// `of_bandwidth`: the time in which a plain copy, measured here, moves the bytes read and written, over the
// time taken.

#include <chrono>

#include "copy_speed.hpp"
#include <benchmark/benchmark.h>

#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

/// Repeats `convert`, whose last result stays while the next is made, as in a node.
template <class Convert>
void repeat(benchmark::State& state, double bytes, Convert&& convert) {
  double quickest = 1e9;
  decltype(convert()) last;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    last = convert();
    benchmark::DoNotOptimize(last);
    quickest =
        std::min(quickest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  state.counters["ms_quickest"] = 1e3 * quickest;
  state.counters["of_bandwidth"] = bytes / 2 * bench::seconds_to_copy_a_byte() / quickest;
}

/// 640 x 480 points of x, y, z at offsets 0, 4 and 8.
void cloud_of_a_message(benchmark::State& state) {
  const auto step = static_cast<std::uint32_t>(state.range(0));
  sensor_msgs::PointCloud2 message = to_message(PointCloud());
  message.width = 640;
  message.height = 480;
  message.point_step = step;
  message.row_step = 640 * step;
  message.data.assign(std::size_t{message.row_step} * 480, 0);
  repeat(state, 640.0 * 480 * (step + 12), [&] { return to_point_cloud(message); });
}
BENCHMARK(cloud_of_a_message)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);

HeightMap map_of_four_layers() {
  HeightMap map(GridGeometry(0, 0, 0.002, 1000, 1000));
  for (const char* name : {"elevation", "variance", "rate", "rate_variance"}) map.add(name, 1);
  return map;
}

void message_of_a_map(benchmark::State& state) {
  const HeightMap map = map_of_four_layers();
  repeat(state, 2.0 * 4 * 4e6, [&] { return to_message(map, std_msgs::Header()); });
}
BENCHMARK(message_of_a_map)->Unit(benchmark::kMillisecond);

void map_of_a_message(benchmark::State& state) {
  const grid_map_msgs::GridMap message = to_message(map_of_four_layers(), std_msgs::Header());
  repeat(state, 2.0 * 4 * 4e6, [&] { return to_height_map(message); });
}
BENCHMARK(map_of_a_message)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
