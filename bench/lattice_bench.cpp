/// How fast beds of single grains move: ejections per second of the slice of the thesis and of the lattice in
/// three dimensions, on one core. Open ripple scripts move half a million cells a second.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/bedforms.hpp"

namespace aeolian {
namespace {

void count(benchmark::State& state, double ejections) {
  constexpr double open_scripts = 0.5e6;
  using benchmark::Counter;
  state.counters["ejections/s"] = Counter(ejections, Counter::kIsRate);
  state.counters["of_open_scripts"] = Counter(ejections / open_scripts, Counter::kIsRate);
}

/// Twenty ejections per surface grain from a flat bed; arguments: reptation length, share of brink ejections
/// in percent.
void lattice_slice(benchmark::State& state) {
  SliceParameters parameters;
  parameters.forward = parameters.backward = static_cast<int>(state.range(0));
  parameters.brink_share = static_cast<double>(state.range(1)) / 100;
  double ejections = 0;
  std::uint64_t member = 0;
  for (auto _ : state) {
    LatticeSlice bed(parameters, 1, member++);
    bed.shoot(10 * parameters.columns);
    ejections += static_cast<double>(bed.counts().ejections());
    benchmark::DoNotOptimize(bed);
  }
  count(state, ejections);
}
BENCHMARK(lattice_slice)->Args({4, 0})->Args({8, 0})->Args({8, 30})->Unit(benchmark::kMicrosecond);

/// A lattice of 1 m x 0.5 m at 0.8 mm that has no ripples yet; the argument is the wind's direction in
/// degrees.
void lattice_bed(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  Grain grain;
  grain.diameter = 0.0004;
  const double direction = static_cast<double>(state.range(0)) * M_PI / 180;
  const Forcing forcing = make_forcing(steady_saltation(0.45, grain), direction, grain, MeanSplash{});
  LatticeBed bed(1250, 626, 0.0008, grain.angle_of_repose, 1);
  for (auto _ : state) bed.advance(forcing, 2);
  count(state, static_cast<double>(bed.ejections()));
}
BENCHMARK(lattice_bed)->Arg(0)->Arg(5)->Arg(90)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
