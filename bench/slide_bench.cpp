/// How fast the material point method is: particle-steps a second in two and three dimensions, on one thread
/// and on two, against what was asked for and what memory allows, and what a settled pile costs.

#include <chrono>

#include "copy_speed.hpp"
#include <benchmark/benchmark.h>

#include "aeolian_core/slide/mpm/snow_body.hpp"

namespace aeolian {
namespace {

constexpr double asked_2d = 8e6;  ///< particle-steps a second on one core
constexpr double asked_3d = 2e6;
constexpr int steps = 20;

/// A block of fresh snow that squeezes itself on the ground.
template <int Dim>
MaterialPoints<Dim> block(std::size_t particles, int threads, Transfer transfer, double rest_speed = 0) {
  const SnowLaw law;
  MpmSettings settings;
  settings.threads = threads;
  settings.transfer = transfer;
  settings.rest_speed = rest_speed;
  settings.rest_patience = 1e-4;
  MaterialPoints<Dim> world(settings, law,
                            {{std::make_shared<HalfSpace<Dim>>(Point<Dim>::Zero(), Point<Dim>::Unit(Dim - 1)),
                              Contact::sticky, 0, Point<Dim>::Zero()}});
  const double per_cell = Dim == 2 ? 4 : 8;
  SnowBox<Dim> box;
  box.corner[Dim - 1] = 0.25 * settings.cell;
  const double height = Dim == 2 ? 0.2 : 0.1;
  const double volume = static_cast<double>(particles) / per_cell * std::pow(settings.cell, Dim);
  box.size = Point<Dim>::Constant(Dim == 2 ? volume / height : std::sqrt(volume / height));
  box.size[Dim - 1] = height;
  world.add(filled_box(box, law, settings.cell, per_cell, 0.2, 1));
  return world;
}

/// Arguments: threads, thousands of particles.
template <int Dim, Transfer transfer>
void particle_steps(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(0));
  auto world = block<Dim>(static_cast<std::size_t>(1000 * state.range(1)), threads, transfer);
  const double dt = world.longest_step();
  world.advance(steps * dt);
  const long before = world.work().particle_steps;
  for (auto _ : state) world.advance(steps * dt);
  const auto done = static_cast<double>(world.work().particle_steps - before);
  state.counters["particle-steps/s"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
  state.counters["of what was asked"] =
      benchmark::Counter(done / (Dim == 2 ? asked_2d : asked_3d), benchmark::Counter::kIsRate);
  // Reading and writing a pack once a step, were nothing else to do.
  const double bytes = static_cast<double>(sizeof(Pack<Dim>)) / lane_count;
  state.counters["of copying"] =
      benchmark::Counter(done * bytes * bench::seconds_to_copy_a_byte(), benchmark::Counter::kIsRate);
}
// The time of the calling thread is that of the work only on one thread.
BENCHMARK_TEMPLATE(particle_steps, 2, Transfer::apic)
    ->Args({1, 20})
    ->Args({1, 100})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(particle_steps, 3, Transfer::apic)
    ->Args({1, 20})
    ->Args({1, 100})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(particle_steps, 2, Transfer::flip)->Args({1, 20})->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(particle_steps, 3, Transfer::flip)->Args({1, 20})->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(particle_steps, 2, Transfer::apic)
    ->Args({2, 100})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(particle_steps, 3, Transfer::apic)
    ->Args({2, 100})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// A settled pile of 1e5 particles over the same kept awake.
void settled(benchmark::State& state) {
  auto awake = block<2>(100000, 1, Transfer::apic);
  auto asleep = block<2>(100000, 1, Transfer::apic, 0.2);  // so loose a bound that it is at rest at once
  asleep.advance(1e-3);
  const double dt = awake.longest_step();
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  awake.advance(steps * dt);
  const std::chrono::duration<double> active = Clock::now() - start;
  long rounds = 0;
  double spent = 0;
  for (auto _ : state) {
    const auto begin = Clock::now();
    asleep.advance(steps * dt);
    spent += std::chrono::duration<double>(Clock::now() - begin).count();
    ++rounds;
  }
  state.counters["of an active one"] = spent / static_cast<double>(rounds) / active.count();
  state.counters["awake"] = static_cast<double>(asleep.awake());
}
BENCHMARK(settled)->Iterations(100);

}  // namespace
}  // namespace aeolian
