/// How fast beds move: cell updates of the ripple model, and the exposure kernel against the bandwidth of
/// this machine's memory, measured in the same run.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/bedforms.hpp"

namespace aeolian {
namespace {

constexpr double cell = 0.002;

Forcing wind(double direction) {
  Grain grain;
  grain.diameter = 0.0004;
  return make_forcing(steady_saltation(0.45, grain), direction, grain, MeanSplash{});
}

/// Bytes per second of memcpy, read and written, over buffers that no cache holds.
double memory_bandwidth() {
  static const double measured = [] {
    std::vector<char> from(std::size_t{1} << 28, 1);
    std::vector<char> to(from.size(), 2);
    double fastest = 1e300;
    for (int n = 0; n < 5; ++n) {
      const std::clock_t start = std::clock();  // processor time, like the counters below
      std::memcpy(to.data(), from.data(), from.size());
      benchmark::DoNotOptimize(to.data());
      benchmark::ClobberMemory();
      fastest = std::min(fastest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return 2 * static_cast<double>(from.size()) / fastest;
  }();
  return measured;
}

std::vector<double> rippled(std::size_t cells) {
  std::vector<double> h(cells);
  for (std::size_t i = 0; i < cells; ++i) h[i] = 0.004 * std::sin(0.07 * static_cast<double>(i));
  return h;
}

/// The unit of work is a cell over the time in which a flat bed loses half the drop of a falling grain over
/// one cell, the longest stable step of Euler's method, whatever steps the model takes.
double unit_step(const Forcing& forcing) {
  return 0.5 * cell * std::tan(forcing.impact_angle) / forcing.erosion_rate();
}

void count(benchmark::State& state, double cells, double duration, const Forcing& forcing) {
  using benchmark::Counter;
  const double updates = cells * duration / unit_step(forcing);
  state.counters["cell_updates/s"] = Counter(updates, Counter::kIsIterationInvariantRate);
  // A step of the model is two units; the least it could do is to read the bed and write it.
  state.counters["of_bandwidth"] =
      Counter(16 * updates / 2 / memory_bandwidth(), Counter::kIsIterationInvariantRate);
  state.counters["times_real_time"] = Counter(duration, Counter::kIsIterationInvariantRate);
}

/// Ripples on 512 x 512 cells; arguments: the wind's direction in degrees, threads. Process time is of all
/// threads together.
void ripple_model(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  const GridGeometry g(0, 0, cell, 512, 512);
  const Forcing forcing = wind(static_cast<double>(state.range(0)) * M_PI / 180);
  const double duration = 200;
  RippleModel model(RippleParameters{});
  std::vector<double> start(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      start[g.index(x, y)] = 0.003 * std::sin(60 * (g.x(x) + 0.05 * std::sin(20 * g.y(y))));
  std::vector<double> first = start;
  model.advance(g, first, forcing, 1);  // fetches the memory
  for (auto _ : state) {
    std::vector<double> h = start;
    model.advance(g, h, forcing, duration);
    benchmark::DoNotOptimize(h.data());
  }
  count(state, static_cast<double>(g.size()), duration, forcing);
}
BENCHMARK(ripple_model)
    ->ArgsProduct({{0, 17, 45, 90}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// A square of sand on bare hard ground of 1024 x 1024 cells; the argument is its share in percent.
void sand_on_rock(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const GridGeometry g(0, 0, cell, 1024, 1024);
  const Forcing forcing = wind(0.3);
  const double side = std::sqrt(static_cast<double>(state.range(0)) / 100) * 1024;
  HeightMap start(g);
  start.add(layer::ground, 0.0F);
  HeightMap::Layer& h = start.add(layer::elevation, 0.0F);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      if (std::abs(x - 512) < side / 2 && std::abs(y - 512) < side / 2)
        h[g.index(x, y)] = static_cast<float>(0.01 + 0.002 * std::sin(60 * g.x(x)));
  HeightMap first = start;
  RippleModel(RippleParameters{}).advance(first, forcing, 1);
  std::size_t sandy = 0;
  for (auto _ : state) {
    HeightMap map = start;
    RippleModel(RippleParameters{}).advance(map, forcing, 200);
    const HeightMap::Layer& end = map.layer(layer::elevation);
    sandy =
        static_cast<std::size_t>(std::count_if(end.begin(), end.end(), [](float z) { return z > 1e-5F; }));
  }
  // The wind has spread it by then.
  state.counters["sandy_at_the_end_%"] = 100 * static_cast<double>(sandy) / static_cast<double>(g.size());
  state.counters["times_real_time"] = benchmark::Counter(200, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(sand_on_rock)->Arg(0)->Arg(5)->Arg(10)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);

/// Exposure of rows that together fit no cache: it must read heights and write exposures, 16 bytes a cell.
void exposure_kernel(benchmark::State& state) {
  constexpr std::size_t count = 1024;
  constexpr std::size_t rows = 8192;
  const std::vector<double> h = rippled(count * rows);
  std::vector<double> exposure(h.size());
  const double drop = cell * std::tan(0.2);
  for (auto _ : state) {
    for (std::size_t row = 0; row < rows; ++row)
      exposure_open(&h[row * count], count, drop, h[row * count], &exposure[row * count]);
    benchmark::DoNotOptimize(exposure.data());
    benchmark::ClobberMemory();
  }
  const double bytes = 16 * static_cast<double>(h.size());
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(h.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["of_bandwidth"] =
      benchmark::Counter(bytes / memory_bandwidth(), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(exposure_kernel)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
