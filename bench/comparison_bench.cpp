// Scoring a forecast. The counter `of_one_pass` is the time of a plain sum over the three layers, measured
// here, over the time of a comparison: what is left of the bandwidth after wavelengths, displacements and the
// search for a translation.

#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "copy_speed.hpp"
#include <benchmark/benchmark.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/comparison.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/surface_comparison.hpp"

namespace aeolian {
namespace {

/// Ripples of 8 cm with noise of half a millimetre, moved downwind.
HeightMap::Layer rippled(const GridGeometry& grid, double shift, std::uint64_t stream) {
  RandomStream random(1, stream);
  HeightMap::Layer z(grid.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double along = grid.x(grid.cell_at(i).x) - shift;
    z[i] = static_cast<float>(0.003 * std::sin(2 * M_PI * along / 0.08) + 0.0005 * random.normal());
  }
  return z;
}

double seconds_of_a_pass(const HeightMap::Layer& a, const HeightMap::Layer& b, const HeightMap::Layer& c) {
  const int repeats = 20;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < repeats; ++i)
    for (const auto* layer : {&a, &b, &c}) {
      double sum = std::accumulate(layer->begin(), layer->end(), 0.0);
      benchmark::DoNotOptimize(sum);
    }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / repeats;
}

void compare_maps(benchmark::State& state, double direction) {
  const GridGeometry grid(0, 0, 0.002, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const HeightMap::Layer start = rippled(grid, 0, 0);
  const HeightMap::Layer measured = rippled(grid, 0.02, 1);
  const HeightMap::Layer predicted = rippled(grid, 0.015, 2);
  const double pass = seconds_of_a_pass(start, measured, predicted);
  for (auto _ : state) benchmark::DoNotOptimize(compare(grid, predicted, measured, start, direction));
  const auto rate = benchmark::Counter::kIsIterationInvariantRate;
  state.counters["cells/s"] = benchmark::Counter(static_cast<double>(grid.size()), rate);
  state.counters["of_one_pass"] = benchmark::Counter(pass, rate);
}

/// Difference and level of detection of a million cells as layers, bias, RMSE, NMAD and significant change.
/// `of_bandwidth`: the time in which a plain copy, measured here, moves the bytes of the four layers read and
/// the two written, over the time taken.
void difference_of_maps(benchmark::State& state, bool reuse) {
  const GridGeometry grid(0, 0, 0.002, 1000, 1000);
  const auto map = [&](double shift, std::uint64_t stream) {
    HeightMap result(grid);
    result.add(layer::elevation, rippled(grid, shift, stream));
    result.add(layer::variance, 0.25e-6F);
    return result;
  };
  const HeightMap a = map(0.02, 1);
  const HeightMap b = map(0.015, 2);
  double quickest = 1e9;
  HeightMap map_of_differences;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    map_of_differences = difference_map(a, b, reuse ? std::move(map_of_differences) : HeightMap());
    benchmark::DoNotOptimize(difference_statistics(map_of_differences.layer(layer::difference)));
    benchmark::DoNotOptimize(significant_change(map_of_differences));
    quickest =
        std::min(quickest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  state.counters["ms_quickest"] = 1e3 * quickest;
  state.counters["of_bandwidth"] =
      static_cast<double>(6 * sizeof(float) * grid.size()) / 2 * bench::seconds_to_copy_a_byte() / quickest;
}
BENCHMARK_CAPTURE(difference_of_maps, in_memory_of_the_last, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(difference_of_maps, in_new_memory, false)->Unit(benchmark::kMillisecond);

/// All figures of two maps with their errors, on the threads that there are; with a start the skill as well.
void all_figures(benchmark::State& state, bool with_start) {
  const GridGeometry grid(0, 0, 0.002, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const auto map = [&](double shift, std::uint64_t stream) {
    HeightMap result(grid);
    result.add(layer::elevation, rippled(grid, shift, stream));
    result.add(layer::variance, 0.25e-6F);
    return result;
  };
  const HeightMap start = map(0, 0);
  const HeightMap measured = map(0.02, 1);
  const HeightMap predicted = map(0.015, 2);
  for (auto _ : state)
    benchmark::DoNotOptimize(compare_surfaces(predicted, measured, with_start ? &start : nullptr, {}));
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(grid.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({500, 250})
      ->Args({1000, 1000})
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime();
}
BENCHMARK_CAPTURE(all_figures, of_two_maps, false)->Apply(sizes);
BENCHMARK_CAPTURE(all_figures, with_a_start, true)->Apply(sizes);
BENCHMARK_CAPTURE(compare_maps, along_rows, 0.0)->Apply(sizes);
BENCHMARK_CAPTURE(compare_maps, oblique, 0.5)->Apply(sizes);

}  // namespace
}  // namespace aeolian
