/// What the air of particles costs: steps over level ground at the thesis' counts and up to a million, on one
/// core and on two, beside a search for neighbours alone. `./twin bench wind_sph`; docs/terrain_wind.md has
/// the results.

#include <cmath>

#include "../test/aeolian_core/wind/sph/air_box.hpp"
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace aeolian::sph {
namespace {

/// Lattices of 2352, 7200, 25 200 and more particles.
struct Shape {
  int nx, ny, nz;
};
Shape shape_of(std::int64_t particles) {
  switch (particles) {
    case 2352:
      return {14, 14, 12};
    case 7200:
      return {20, 20, 18};
    case 25200:
      return {30, 30, 28};
    default: {
      const int side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles))));
      return {side, side, side};
    }
  }
}

SphAir box_of(std::int64_t particles) {
  const Shape s = shape_of(particles);
  const AirBox box(world(s.nx, s.ny, 1, [](double x, double y) { return gaussian(std::hypot(x, y), 1, 3); }),
                   s.nx, s.ny, s.nz, 3, 3);
  AirSettings settings;
  settings.support = 2;  // at which the thesis' frames are counted
  SphAir air = box.air({}, settings);
  for (int i = 0; i < 5; ++i) air.step();
  return air;
}

/// Arguments: particles, threads.
void steps(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  SphAir air = box_of(state.range(0));
  double iterations = 0;
  for (auto _ : state) {
    air.step();
    iterations += air.iterations();
  }
  const auto n = static_cast<double>(air.size());
  state.counters["pressure_iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
  state.counters["particle_steps/s"] = benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate);
  state.SetComplexityN(static_cast<std::int64_t>(air.size()));
}
// Two threads first: a process whose first work was held to one thread keeps to it.
BENCHMARK(steps)->Args({25200, 2})->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(steps)
    ->ArgsProduct({{2352, 7200, 10000, 25200, 100000, 300000, 1000000}, {1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->Complexity([](benchmark::IterationCount n) { return static_cast<double>(n); });

/// The peer: neighbours found and nothing done with them but their gradients.
void neighbours_alone(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  SphAir air = box_of(state.range(0));
  air.divergence();
  NeighbourFinder finder(air.torus(), 2);
  const std::vector<Four> normal(air.size(), Four{0, 0, 1, 0});
  for (auto _ : state) {
    finder.find(air.cells(), air.place(), normal);
    benchmark::DoNotOptimize(finder.rows().gradient.data());
  }
  state.counters["particles/s"] =
      benchmark::Counter(static_cast<double>(air.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(neighbours_alone)->Arg(7200)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace aeolian::sph
