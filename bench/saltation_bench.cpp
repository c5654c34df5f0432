/// How fast saltation is: flights against the arithmetic of this machine, steady states cold and warm, the
/// table and the three-number law.

#include <cmath>
#include <memory>

#include "../test/aeolian_core/saltation/thesis_bed.hpp"
#include <benchmark/benchmark.h>

#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/kok_renno.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/literal_iteration.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"
#include "aeolian_core/saltation/transient_saltation.hpp"

namespace aeolian {
namespace {

/// Sixty flights of one iteration; beside it the drag law as printed, of which a step without tables would
/// need three.
void flights(benchmark::State& state) {
  const SaltatingBed bed = thesis_bed();
  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1);
  WindProfile wind(bed.roughness_length());
  wind.set_logarithmic(0.35);
  Launches launches;
  launches.resize(60);
  double steps = 0;
  for (std::size_t k = 0; k < 60; ++k) {
    launches.vy[k] = 0.05 * (static_cast<double>(k) + 0.5);
    launches.number[k] = 1;
    steps += static_cast<double>(trace(0, launches.vy[k], {wind, drag}).size());
  }
  Landings landings;
  landings.resize(60);
  std::vector<double> stress(WindProfile::levels);
  for (auto _ : state) {
    fly(launches, 0, {wind, drag}, landings, stress);
    benchmark::DoNotOptimize(stress.data());
  }
  state.counters["steps/s"] = benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate);
}

/// The drag law as printed, once: what a step without a table would have to pay three times.
void printed_drag_law(benchmark::State& state) {
  double reynolds = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(drag_coefficient(DragLaw::sphere, reynolds));
    reynolds = reynolds < 100 ? reynolds * 1.001 : 1;
  }
}

void report(benchmark::State& state, const SteadyState& s, double bar_milliseconds) {
  state.counters["iterations"] = s.iterations;
  // The bar over the time of one solve: above one is faster than asked for.
  state.counters["bar/time"] =
      benchmark::Counter(bar_milliseconds / 1e3, benchmark::Counter::kIsIterationInvariantRate);
}

/// Eq. 4.34; arguments: case, u* [cm/s].
void vertical(benchmark::State& state) {
  const SaltationSolver solver(thesis_bed(), thesis_splash(static_cast<int>(state.range(0))));
  const double u = static_cast<double>(state.range(1)) / 100;
  for (auto _ : state) benchmark::DoNotOptimize(solver.solve(u).replacement);
  report(state, solver.solve(u), 5);
}

/// The same from the state of a wind that was 2 % weaker.
void vertical_warm(benchmark::State& state) {
  const SaltationSolver solver(thesis_bed(), thesis_splash(static_cast<int>(state.range(0))));
  const double u = static_cast<double>(state.range(1)) / 100;
  const SteadyState before = solver.solve(u / 1.02);
  for (auto _ : state) benchmark::DoNotOptimize(solver.solve(u, &before).replacement);
  report(state, solver.solve(u, &before), 5);
}

void literal(benchmark::State& state) {
  const DistributionKernel kernel = thesis_splash(1);
  for (auto _ : state)
    benchmark::DoNotOptimize(literal_iteration(thesis_bed(), kernel, 0.75, 1e-3).replacement);
  report(state, literal_iteration(thesis_bed(), kernel, 0.75, 1e-3), 5);
}

void kok_renno(benchmark::State& state) {
  const SaltatingBed bed;
  const SaltationSolver solver(bed, KokRennoKernel(bed.grain, bed.atmosphere));
  for (auto _ : state) benchmark::DoNotOptimize(solver.solve(0.5).replacement);
  report(state, solver.solve(0.5), 100);
}

/// Any splash in two components: that of Kok & Renno with its balance of each event.
void two_components(benchmark::State& state) {
  const SaltatingBed bed;
  const auto splash = std::make_shared<ComposedSplash>(std::make_shared<KokRennoRebound>(),
                                                       std::make_shared<KokRennoEjection>(bed.grain));
  const SaltationSolver solver(bed, SampledKernel(splash, "balanced", bed.grain, bed.atmosphere));
  for (auto _ : state) benchmark::DoNotOptimize(solver.solve(0.5).replacement);
  report(state, solver.solve(0.5), 100);
}

/// A second of a gust by eq. 4.35.
void one_second_in_time(benchmark::State& state) {
  const SaltatingBed bed;
  const KokRennoKernel splash(bed.grain, bed.atmosphere, {}, 3, 8);
  const SteadyState begin = SaltationSolver(bed, splash).solve(0.4);
  for (auto _ : state) {
    TransientSaltation saltation(bed, splash);
    saltation.begin(begin);
    saltation.advance(1, 0.45);
    benchmark::DoNotOptimize(saltation.mass_flux());
  }
}

const SaltationTable& table() {
  static const SaltationTable solved = SaltationTable::build(
      {}, [](const SaltatingBed& bed) { return std::make_unique<KokRennoKernel>(bed.grain, bed.atmosphere); },
      {0.0002, 0.00025, 0.000315}, SaltationTable::usual_ratios());
  return solved;
}

void table_look_up(benchmark::State& state) {
  const SaltationTable& solved = table();
  double u = 0.2;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solved.state(u, 0.00027).mass_flux);
    u = u < 1 ? u + 1e-5 : 0.2;
  }
  state.counters["error"] = solved.error();
}

void three_number_law(benchmark::State& state) {
  const FluxLaw law = table().law(0.00025);
  double u = 0.2;
  for (auto _ : state) {
    benchmark::DoNotOptimize(law.flux(u));
    u = u < 1 ? u + 1e-5 : 0.2;
  }
}

/// With its means of impacts, as the forecaster asks for it.
void steady_saltation_law(benchmark::State& state) {
  const Grain grain;
  double u = 0.2;
  for (auto _ : state) {
    benchmark::DoNotOptimize(steady_saltation(u, grain).mass_flux);
    u = u < 1 ? u + 1e-5 : 0.2;
  }
}

BENCHMARK(flights)->Unit(benchmark::kMicrosecond);
BENCHMARK(printed_drag_law)->Unit(benchmark::kNanosecond);
BENCHMARK(vertical)
    ->ArgNames({"case", "u"})
    ->Args({1, 35})
    ->Args({1, 75})
    ->Args({1, 125})
    ->Args({2, 75})
    ->Args({3, 75})
    ->Args({4, 50})
    ->Args({5, 100})
    ->Args({6, 150})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(vertical_warm)
    ->ArgNames({"case", "u"})
    ->Args({1, 75})
    ->Args({2, 75})
    ->Args({5, 100})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(literal)->Unit(benchmark::kMillisecond);
BENCHMARK(kok_renno)->Unit(benchmark::kMillisecond);
BENCHMARK(two_components)->Unit(benchmark::kMillisecond);
BENCHMARK(one_second_in_time)->Unit(benchmark::kMillisecond);
BENCHMARK(table_look_up)->Unit(benchmark::kNanosecond);
BENCHMARK(three_number_law)->Unit(benchmark::kNanosecond);
BENCHMARK(steady_saltation_law)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace aeolian
