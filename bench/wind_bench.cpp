/// What the wind over terrain costs: one direction of linear theory over 512 x 512 cells, what is cached, and
/// the mass-consistent wind in 0.4 million boxes; each beside a plain copy of as many bytes as its answer
/// has, or per box. `./twin bench wind`; docs/terrain_wind.md has the results.

#include <cmath>

#include "../test/aeolian_core/wind/relief_worlds.hpp"
#include "copy_speed.hpp"
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace aeolian {
namespace {

HeightMap hills(int n) {
  return world(n, n, 1, [n](double x, double y) {
    return gaussian(std::hypot(x + 0.1 * n, y), 0.016 * n, 0.06 * n) +
           0.3 * std::sin(x / 11) * std::sin(y / 17);
  });
}

WindInput wind(double direction, double speed = 8) {
  WindInput input;
  input.speed = speed;
  input.height = 2;
  input.direction = direction;
  return input;
}

/// Argument: threads, two for as many as there are.
void spectral(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const HeightMap map = hills(512);
  const SpectralWind model(ReliefSettings{});
  for (auto _ : state) benchmark::DoNotOptimize(model.solve(map, 0.3).friction.data());
}
BENCHMARK(spectral)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void cached(benchmark::State& state) {
  const HeightMap map = hills(512);
  TerrainWind model({});
  model.solve(wind(0), &map);
  double speed = 5;
  for (auto _ : state)
    benchmark::DoNotOptimize(model.solve(wind(0.02, speed += 0.01), &map).cells.names().data());
  if (model.solutions() != 1) state.SkipWithError("it was solved anew");
  // Reads the map, its copy and three layers of the solution, writes three.
  const double copies = 4.0 * 512 * 512 * 4 * bench::seconds_to_copy_a_byte();
  state.counters["copies"] =
      benchmark::Counter(copies, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(cached)->Unit(benchmark::kMillisecond);

void changed_tile_below_the_bound(benchmark::State& state) {
  HeightMap map = hills(512);
  TerrainWind model({});
  model.solve(wind(0), &map);
  HeightMap::Layer& z = map.layer(layer::elevation);
  float step = 1e-4F;
  for (auto _ : state) {
    for (int y = 64; y < 96; ++y)
      for (int x = 64; x < 96; ++x) z[map.geometry().index(x, y)] += step;
    step = -step;
    benchmark::DoNotOptimize(model.solve(wind(0), &map).cells.names().data());
  }
  if (model.solutions() != 1) state.SkipWithError("it was solved anew");
}
BENCHMARK(changed_tile_below_the_bound)->Unit(benchmark::kMillisecond);

void mass_consistent(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const WindRelief relief = wind_relief(
      world(80, 80, 10, [](double x, double y) { return gaussian(std::hypot(x, y), 100, 110); }), 0);
  const UpwindProfile upwind = UpwindProfile::log_law(0.03);
  double boxes = 0;
  for (auto _ : state) {
    const MassConsistentVolume v(relief, 0.3, upwind, {});
    boxes = static_cast<double>(v.flows().nx()) * v.flows().ny() * v.flows().nz();
    state.counters["iterations_of_the_solver"] = v.iterations();
  }
  state.counters["boxes"] = boxes;
  state.counters["boxes/s"] = benchmark::Counter(boxes, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(mass_consistent)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace aeolian
