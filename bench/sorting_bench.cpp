/// What sorting costs: cell updates of SortedRippleModel against RippleModel's on the same 512 x 512 cells,
/// in one run. `./twin bench sorting`; docs/sorting.md has the results.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/bedforms.hpp"

namespace aeolian {
namespace {

constexpr double cell = 0.002;
constexpr double duration = 200;
constexpr int passes = 3;
enum Bed { young, mature };

Forcing wind(double direction) {
  Grain grain;
  grain.diameter = 0.0004;
  return make_forcing(steady_saltation(0.45, grain), direction, grain, MeanSplash{});
}

/// Sines of 3 mm, or ripples with slip faces at repose.
const std::vector<double>& start(const GridGeometry& g, Bed bed) {
  static std::map<Bed, std::vector<double>> beds;
  std::vector<double>& h = beds[bed];
  if (!h.empty()) return h;
  h.resize(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      h[g.index(x, y)] = 0.003 * std::sin(60 * (g.x(x) + 0.05 * std::sin(20 * g.y(y))));
  if (bed == mature) RippleModel(RippleParameters{}).advance(g, h, wind(0), 1200);
  return h;
}

/// Processor time of the best of some passes [s].
template <class Run>
double best_time(Run&& run) {
  double best = 1e300;
  for (int n = 0; n < passes; ++n) {
    const std::clock_t begin = std::clock();
    run();
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

/// Arguments: direction of the wind in degrees, bed, and coarse diameter in units of 0.4 mm. Grains alike
/// take RippleModel's steps, so that their ratio is that of updates; others take shorter ones where coarse
/// grains, which are set moving faster, are many.
void sorted_ripples(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const GridGeometry g(0, 0, cell, 512, 512);
  const Forcing forcing = wind(static_cast<double>(state.range(0)) * M_PI / 180);
  SortedRippleParameters p;
  p.coarse_diameter = static_cast<double>(state.range(2)) * forcing.grain.diameter;
  p.active_layer = 0.004 / p.coarse_diameter;  // so thick that it does not shorten steps
  p.stratum = 0.0008 / p.coarse_diameter;
  const std::vector<double>& h = start(g, static_cast<Bed>(state.range(1)));
  const double one_size = best_time([&] {
    std::vector<double> height = h;
    RippleModel(p.ripples).advance(g, height, forcing, duration);
    benchmark::DoNotOptimize(height.data());
  });
  double two_sizes = 0;
  for (auto _ : state)
    two_sizes = best_time([&] {
      SortedBed bed(g, h, p.layers());
      SortedRippleModel(p).advance(bed, sorted_forcing(forcing, p.coarse_diameter), duration);
      benchmark::DoNotOptimize(bed.height.data());
    });
  // The unit of work of bedforms_bench.cpp.
  const double units = duration * forcing.erosion_rate() / (0.5 * cell * std::tan(forcing.impact_angle));
  state.counters["cell_updates/s"] = static_cast<double>(g.size()) * units / two_sizes;
  state.counters["times_one_size"] = two_sizes / one_size;
  state.counters["times_real_time"] = duration / two_sizes;
}
BENCHMARK(sorted_ripples)
    ->ArgsProduct({{0, 17, 45}, {young, mature}, {1, 2}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
