// What a reading of an anemometer costs wind_estimator once its sector is solved: over a rippled bed (one
// cell is told), over a hill (a map of 6 layers is), with gust statistics of ten minutes at 10 Hz, and
// probes.
//
// `of_bandwidth`: the time in which a plain copy through memory, measured here, moves the bytes that a
// reading must read and write, over the time taken; above one they were in the cache. `solutions`: how often
// the wind over the map was solved, for all readings together.
//
//     ./twin bench wind_reader

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "copy_speed.hpp"
#include <benchmark/benchmark.h>
#include <tf2/buffer_core.h>

#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/wind_prober.hpp"

namespace aeolian {
namespace {

HeightMap map_of(int n, double cell, const std::function<double(double, double)>& height) {
  HeightMap map(GridGeometry(-0.5 * n * cell, -0.5 * n * cell, cell, n, n));
  HeightMap::Layer& z = map.add(layer::elevation);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const CellIndex c = map.geometry().cell_at(i);
    z[i] = static_cast<float>(height(map.geometry().x(c.x), map.geometry().y(c.y)));
  }
  return map;
}

/// A reader with its map, and readings at 10 Hz that veer a little.
class Station {
 public:
  explicit Station(const HeightMap& map)
      : parameters_(describe_wind_estimator().parameters, "wind_estimator", {}),
        reader(parameters_, "wind", tf_, [](const std::string&, bool, const std::string&) {}) {
    reader.take_map(map);
  }
  std::optional<grid_map_msgs::GridMap> read() {
    geometry_msgs::TwistStamped message;
    message.header.frame_id = "map";
    message.header.stamp = ros::Time(1000, 0) + ros::Duration(0.1 * static_cast<double>(++count_));
    message.twist.linear.x = 8 + std::sin(static_cast<double>(count_));
    message.twist.linear.y = 0.3 * std::sin(0.7 * static_cast<double>(count_));
    return reader.take_wind(message);
  }

 private:
  Parameters parameters_;
  tf2::BufferCore tf_;
  std::size_t count_ = 0;

 public:
  WindReader reader;
};

void reading(benchmark::State& state, const HeightMap& map) {
  Station station(map);
  // The elevations are compared with those of the last reading; the layers of the message are written.
  const auto first = station.read();
  double bytes = 2.0 * sizeof(float) * static_cast<double>(map.geometry().size());
  for (const auto& layer : first->data) bytes += sizeof(float) * static_cast<double>(layer.data.size());
  double quickest = 1e9;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(station.read());
    quickest =
        std::min(quickest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  state.counters["ms_quickest"] = 1e3 * quickest;
  state.counters["of_bandwidth"] = bytes / 2 * bench::seconds_to_copy_a_byte() / quickest;
  state.counters["solutions"] = station.reader.model().solutions();
}

void reading_over_ripples(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  reading(state, map_of(n, 0.002, [](double x, double) { return 0.003 * std::sin(2 * M_PI * x / 0.1); }));
}
BENCHMARK(reading_over_ripples)->Arg(512)->Arg(1000)->Unit(benchmark::kMillisecond);

HeightMap hill(int n) {
  return map_of(n, 1, [n](double x, double y) { return 0.02 * n * std::exp(-(x * x + y * y) * 40 / n / n); });
}

void reading_over_a_hill(benchmark::State& state) { reading(state, hill(static_cast<int>(state.range(0)))); }
BENCHMARK(reading_over_a_hill)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);

void gust_statistics(benchmark::State& state) {
  Station station(map_of(32, 0.01, [](double, double) { return 0.0; }));
  for (int i = 0; i < 6100; ++i) station.read();
  for (auto _ : state) benchmark::DoNotOptimize(station.reader.statistics());
}
BENCHMARK(gust_statistics)->Unit(benchmark::kMillisecond);

void hundred_probes_over_a_hill(benchmark::State& state) {
  Station station(hill(128));
  station.read();
  WindProber prober(station.reader);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(i - 50, 0.5 * i - 25, 6);
  prober.at(points);
  for (auto _ : state) benchmark::DoNotOptimize(prober.at(points));
}
BENCHMARK(hundred_probes_over_a_hill)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
