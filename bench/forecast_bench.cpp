/// What an ensemble forecast costs: a plot of 1 m x 0.5 m at 2 mm, a minute of gusty wind at 10 Hz, horizons
/// of half a minute to five. `real_time` is the 10 s between forecasts over the time that one takes.

#include <cmath>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/forecast_ensemble.hpp"
#include "aeolian_core/twin/forecast_spread.hpp"
#include "aeolian_core/twin/map_error.hpp"

namespace aeolian {
namespace {

constexpr double period = 10;  // between forecasts [s]
const std::vector<double> horizons{30, 60, 120, 300};
const GridGeometry plot(0, 0, 0.002, 500, 250);

TwinPhysics physics() {
  TwinPhysics result;
  result.grain.diameter = 0.0004;
  result.ripple.wavelength_law = make_wavelength_law("constant", 250);
  return result;
}

/// Ripples of 80 mm and the noise of a measured map.
HeightMap measured() {
  HeightMap map(plot);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  RandomStream random(1, 1);
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    const CellIndex cell = plot.cell_at(i);
    const double phase = 2 * M_PI * (plot.x(cell.x) + 0.01 * std::sin(12 * plot.y(cell.y))) / 0.08;
    elevation[i] = static_cast<float>(0.003 * std::sin(phase) + 2e-4 * random.normal());
  }
  map.add(layer::variance, 4e-8F);
  return map;
}

std::vector<WindSpell> wind() {
  WindCourse course({});
  RandomStream random(1, 2);
  for (int i = 0; i <= 600; ++i) {
    WindSample sample;
    sample.time = 0.1 * i;
    sample.friction_velocity = 0.45 * (1 + 0.1 * random.normal());
    sample.direction = 0.05 * random.normal();
    course.add(sample);
  }
  return course.spells(60, horizons.back());
}

/// Arguments: members, cell of the members in mm, threads.
void forecast(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(2)));
  ForecastEnsemble::Settings settings;
  settings.member_cell = 1e-3 * static_cast<double>(state.range(1));
  const ForecastEnsemble ensemble(physics(), settings);
  const auto members = draw_parameters(default_priors(), static_cast<std::size_t>(state.range(0)), 1);
  const HeightMap start = measured();
  const std::vector<WindSpell> spells = wind();
  for (auto _ : state) benchmark::DoNotOptimize(ensemble.run(start, spells, horizons, members, {}));
  state.counters["real_time"] = benchmark::Counter(period, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(forecast)
    ->ArgNames({"members", "mm", "threads"})
    ->Args({0, 0, 1})
    ->Args({0, 0, 2})
    ->Args({20, 4, 1})
    ->Args({20, 4, 2})
    ->Args({20, 6, 1})
    ->Args({20, 2, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// Nothing can move: what members cost then.
void calm(benchmark::State& state) {
  ForecastEnsemble::Settings settings;
  settings.member_cell = 0.004;
  const ForecastEnsemble ensemble(physics(), settings);
  const auto members = draw_parameters(default_priors(), 20, 1);
  const HeightMap start = measured();
  std::vector<WindSpell> spells = wind();
  for (WindSample& sample : spells[0].samples) sample.friction_velocity *= 0.1;
  for (auto _ : state) benchmark::DoNotOptimize(ensemble.run(start, spells, horizons, members, {}));
}
BENCHMARK(calm)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The parts: the forcing of one member, the error of its map, the spread of one horizon.
void forcing(benchmark::State& state) {
  const TwinPhysics sand = physics();
  const std::vector<WindSpell> spells = wind();
  for (auto _ : state) benchmark::DoNotOptimize(forcing_of(sand, spells[0], {}));
}
BENCHMARK(forcing)->Unit(benchmark::kMillisecond);

void map_error(benchmark::State& state) {
  const GridGeometry coarse(0, 0, 0.004, 250, 125);
  std::uint64_t stream = 0;
  for (auto _ : state) benchmark::DoNotOptimize(smooth_noise(coarse, 0.02, 1, ++stream));
}
BENCHMARK(map_error)->Unit(benchmark::kMillisecond);

void spread(benchmark::State& state) {
  const GridGeometry coarse(0, 0, 0.004, 250, 125);
  std::vector<HeightMap::Layer> members;
  for (std::uint64_t i = 0; i < 20; ++i) members.push_back(smooth_noise(coarse, 0.02, 1, i));
  std::vector<const HeightMap::Layer*> pointers;
  for (const HeightMap::Layer& member : members) pointers.push_back(&member);
  const HeightMap start = measured();
  for (auto _ : state)
    benchmark::DoNotOptimize(spread_of(pointers, coarse, 1e-4, BorderError{0, 0.05, 1e-3}, start));
}
BENCHMARK(spread)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
