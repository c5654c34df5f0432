/// What it costs to find and follow ripples on maps, against one discrete Fourier transform of the same map
/// measured in the same run (the least that a search for the dominant wave could do).

#include <cmath>
#include <ctime>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// Sinuous ripples of 25 cells with noise of a twentieth of their height, moved by a phase.
HeightMap::Layer ripples(const GridGeometry& g, double phase) {
  RandomStream random(1, 0);
  HeightMap::Layer layer(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      layer[g.index(x, y)] = static_cast<float>(
          0.0015 * std::sin(2 * M_PI * (x + 0.3 * y + 6 * std::sin(0.03 * y)) / 25 - phase) +
          1.5e-4 * random.normal());
  return layer;
}

double transform_seconds(int side) {
  cv::Mat image(side, side, CV_32F, cv::Scalar(1));
  cv::Mat transform;
  double fastest = 1e300;
  for (int n = 0; n < 5; ++n) {
    const std::clock_t start = std::clock();
    cv::dft(image, transform, cv::DFT_COMPLEX_OUTPUT);
    fastest = std::min(fastest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return fastest;
}

void report(benchmark::State& state, double seconds, int side) {
  const auto runs = static_cast<double>(state.iterations());
  state.counters["Mcells/s"] = 1e-6 * side * side * runs / seconds;
  state.counters["of_a_transform"] = seconds / runs / transform_seconds(side);
}

/// The argument is the side of the map in cells.
void find(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const GridGeometry g(0, 0, 0.002, side, side);
  const HeightMap::Layer layer = ripples(g, 0);
  const std::clock_t start = std::clock();
  for (auto _ : state) benchmark::DoNotOptimize(ripple_field(find_crests(g, layer, 0.3)));
  report(state, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, side);
}
BENCHMARK(find)->Arg(250)->Arg(500)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

/// One more map for a tracker, its shift against the one before included.
void follow(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const GridGeometry g(0, 0, 0.002, side, side);
  const HeightMap::Layer maps[] = {ripples(g, 0), ripples(g, 0.5)};
  RippleTracker tracker(0.3);
  double time = 0;
  const std::clock_t start = std::clock();
  for (auto _ : state) {
    tracker.add(g, maps[static_cast<int>(time) % 2], time);
    time += 1;
  }
  report(state, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, side);
}
BENCHMARK(follow)->Arg(500)->Arg(1000)->Unit(benchmark::kMillisecond);

/// Tracks and events of twenty maps that have been added.
void conclude(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const GridGeometry g(0, 0, 0.002, side, side);
  RippleTracker tracker(0.3);
  for (int m = 0; m < 20; ++m) tracker.add(g, ripples(g, 0.3 * m), m);
  const std::clock_t start = std::clock();
  for (auto _ : state) benchmark::DoNotOptimize(tracker.history());
  report(state, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, side);
}
BENCHMARK(conclude)->Arg(500)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
