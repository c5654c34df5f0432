/// Error of the ripple model against run time: over the cells and the wind, against linear theory; over the
/// step and over the bound of its error, against a sixteenth of the longest. docs/ripple_model.md has the
/// results.

#include <cmath>
#include <complex>
#include <map>
#include <vector>

#include "windy_sand.hpp"
#include <benchmark/benchmark.h>

#include "aeolian_core/bedforms/bedforms.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double hop = 0.01;
constexpr double erosion_rate = 1e-4;
const double cot_alpha = 1 / std::tan(10 * M_PI / 180);

/// The fastest-growing wave, crests across the wind; arguments: cells per hop, direction of the wind in
/// degrees, nearly.
void fastest_mode(benchmark::State& state) {
  RippleParameters p;
  p.border = Border::periodic;
  p.relief_scale = 100;
  const double contrast = cot_alpha - p.hop_shortening;
  const double mu = p.slope_effect;
  const double ka = std::sqrt(std::sqrt(contrast / mu) - 1);
  const std::map<std::int64_t, CellIndex> periods{{0, {4, 0}}, {17, {10, 3}}, {30, {7, 4}}, {45, {3, 3}}};
  const CellIndex n = periods.at(state.range(1));
  const auto per_hop = static_cast<double>(state.range(0));
  const int nx = static_cast<int>(std::lround(2 * M_PI / ka * per_hop * std::hypot(n.x, n.y)));
  const GridGeometry g(0, 0, hop / per_hop, nx, n.y == 0 ? 4 : nx);
  const double kx = 2 * M_PI * n.x / g.length_x();
  const double ky = 2 * M_PI * n.y / g.length_y();
  const auto amplitude = [&](const std::vector<double>& h) {
    std::complex<double> total = 0;
    for (int y = 0; y < g.ny(); ++y)
      for (int x = 0; x < g.nx(); ++x)
        total += h[g.index(x, y)] * std::polar(1.0, -(kx * g.x(x) + ky * g.y(y)));
    return total;
  };
  std::vector<double> start(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) start[g.index(x, y)] = 1e-7 * std::cos(kx * g.x(x) + ky * g.y(y));
  Forcing forcing;
  forcing.direction = std::atan2(ky, kx);
  forcing.impact_angle = 10 * M_PI / 180;
  forcing.ejection_rate = erosion_rate / std::pow(forcing.grain.effective_diameter(), 3);
  forcing.reptation_length = hop;
  const double duration = 0.2 * hop / erosion_rate;
  std::vector<double> h;
  for (auto _ : state) {
    h = start;
    RippleModel(p).advance(g, h, forcing, duration);
  }
  const std::complex<double> rate = std::log(amplitude(h) / amplitude(start)) / duration;
  const double k = std::hypot(kx, ky);
  const double q = k * hop;
  const double growth = erosion_rate * (contrast * k * q / (1 + q * q) - mu * hop * k * k);
  const double speed = erosion_rate * contrast * q * q / (1 + q * q);
  state.counters["growth_error_%"] = 100 * (rate.real() / growth - 1);
  state.counters["speed_error_%"] = 100 * (-rate.imag() / k / speed - 1);
}
BENCHMARK(fastest_mode)->ArgsProduct({{20, 10, 5, 4, 3, 2}, {0, 17, 30, 45}})->Unit(benchmark::kMillisecond);

/// A minute of ripples 1.6 mm rms high on 500 x 256 mm; the argument is the step in sixteenths.
void step(benchmark::State& state) {
  const GridGeometry g(0, 0, 0.002, 250, 128);
  const Forcing forcing = windy_sand();
  RippleParameters p;
  p.border = Border::periodic;
  p.step = 1.0 / 16;
  static const std::vector<double> start = [&] {
    RandomStream random(1, 0);
    std::vector<double> h(g.size());
    for (double& z : h) z = 3e-4 * random.normal();
    RippleModel(p).advance(g, h, forcing, 900);
    return h;
  }();
  static const std::vector<double> truth = [&] {
    std::vector<double> h = start;
    RippleModel(p).advance(g, h, forcing, 60);
    return h;
  }();
  p.step = static_cast<double>(state.range(0)) / 16;
  std::vector<double> h;
  for (auto _ : state) {
    h = start;
    RippleModel(p).advance(g, h, forcing, 60);
  }
  double error = 0;
  double change = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    error += (h[i] - truth[i]) * (h[i] - truth[i]);
    change += (truth[i] - start[i]) * (truth[i] - start[i]);
  }
  state.counters["error_mm"] = 1e3 * std::sqrt(error / static_cast<double>(h.size()));
  state.counters["of_change_%"] = 100 * std::sqrt(error / change);
}
BENCHMARK(step)->Arg(2)->Arg(4)->Arg(8)->Arg(12)->Arg(16)->Unit(benchmark::kMillisecond);

/// A minute of ripples that have grown from flat sand by the noise of single grains, on 500 x 256 mm, without
/// that noise; arguments: their age in minutes, the longest step in sixteenths, the bound of the error in
/// hundredths of a mm per minute.
void error_bound(benchmark::State& state) {
  struct Bed {
    std::vector<double> start, truth;
    double rms;
  };
  static std::map<std::int64_t, Bed> beds;
  const GridGeometry g(0, 0, 0.002, 250, 128);
  const Forcing forcing = windy_sand();
  RippleParameters p;
  p.border = Border::periodic;
  const auto rms = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0;
    for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return 1e3 * std::sqrt(square / static_cast<double>(a.size()));
  };
  const auto found = beds.find(state.range(0));
  if (found == beds.end()) {
    Bed& bed = beds[state.range(0)];
    RippleParameters noisy = p;
    noisy.stochastic_share = 1;
    bed.start.assign(g.size(), 0.0);
    RippleModel(noisy).advance(g, bed.start, forcing, 60 * static_cast<double>(state.range(0)));
    bed.rms = rms(bed.start, std::vector<double>(g.size(), 0.0));
    bed.truth = bed.start;
    p.step = 1.0 / 16;
    RippleModel(p).advance(g, bed.truth, forcing, 60);
  }
  const Bed& bed = beds.at(state.range(0));
  p.step = static_cast<double>(state.range(1)) / 16;
  p.error_bound = static_cast<double>(state.range(2)) * 1e-5 / 60;
  std::vector<double> h;
  for (auto _ : state) {
    h = bed.start;
    RippleModel(p).advance(g, h, forcing, 60);
  }
  state.counters["bed_rms_mm"] = bed.rms;
  state.counters["error_mm"] = rms(h, bed.truth);
}
BENCHMARK(error_bound)
    ->ArgsProduct({{5, 10, 15, 30, 90}, {16}, {0, 10, 3}})
    ->ArgsProduct({{5, 10, 15, 30, 90}, {4}, {0}})
    ->Unit(benchmark::kMillisecond);

/// A plot of 1 m x 0.5 m with the noise of single grains; the argument is the share of the cells that draw
/// theirs in a step, in percent.
void stochastic(benchmark::State& state) {
  const GridGeometry g(0, 0, 0.002, 500, 250);
  const Forcing forcing = windy_sand();
  RippleParameters p;
  p.stochastic_share = static_cast<double>(state.range(0)) / 100;
  std::vector<double> start(g.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      start[g.index(x, y)] = 0.003 * std::sin(60 * g.x(x) + std::sin(9 * g.y(y)));
  for (auto _ : state) {
    std::vector<double> h = start;
    RippleModel(p).advance(g, h, forcing, 300);
    benchmark::DoNotOptimize(h.data());
  }
  state.counters["times_real_time"] = benchmark::Counter(300, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(stochastic)->Arg(0)->Arg(10)->Arg(100)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
