// Events per second of each splash function, one core:
//
//     ./twin bench splash
//
// of_random: share of the time that drawing a dozen plain random numbers alone takes, the least that an event
// with one ejectum needs.

#include <ctime>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

double seconds(std::clock_t ticks) { return static_cast<double>(ticks) / CLOCKS_PER_SEC; }

/// What 12 random numbers take [s].
double random_time() {
  RandomStream random(1, 1);
  constexpr int count = 1200000;
  const std::clock_t start = std::clock();
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += random.uniform();
  benchmark::DoNotOptimize(sum);
  return 12 * seconds(std::clock() - start) / count;
}

/// `speed` over sqrt(g d) at 12 degrees.
void run(benchmark::State& state, const Splash& splash, const Grain& grain, double speed) {
  const Impact impact{speed * std::sqrt(gravity * grain.diameter), 12 * degree};
  RandomStream random(1, 1);
  SplashEvent event;
  double ejecta = 0;
  const std::clock_t start = std::clock();
  for (auto _ : state) {
    splash.sample(impact, random, event);
    ejecta += static_cast<double>(event.ejecta.size());
    benchmark::DoNotOptimize(event);
  }
  const double time = seconds(std::clock() - start);
  const auto events = static_cast<double>(state.iterations());
  state.counters["events"] = benchmark::Counter(events, benchmark::Counter::kIsRate);
  state.counters["ejecta"] = ejecta / events;
  state.counters["of_random"] = events * random_time() / time;
}

/// 4 speeds, 4 angles, 3 sizes and 2 roughnesses of 500 events each.
std::shared_ptr<const SplashTable> table(const Grain& grain) {
  const auto splash = splash_of("kok_renno", "fine_sand");
  RandomStream random(2, 1);
  std::vector<SplashCase> cases;
  for (const double speed : {30.0, 60.0, 100.0, 160.0})
    for (const double angle : {8.0, 12.0, 20.0, 40.0})
      for (const double size : {0.5, 1.0, 2.0})
        for (const double roughness : {0.0, 0.2}) {
          SplashCase one{{speed * std::sqrt(gravity * grain.diameter), angle * degree}, {}};
          one.impact.size_ratio = size;
          one.impact.roughness = roughness;
          for (int i = 0; i < 500; ++i) one.events.push_back(splash->sample(one.impact, random));
          cases.push_back(std::move(one));
        }
  return std::make_shared<SplashTable>(SplashTable::build(cases, grain.diameter, {"bench", "sand", 1}));
}

const int registered = [] {
  for (const double speed : {30.0, 100.0}) {
    const std::string at = speed == 30 ? "/slow" : "/fast";
    for (const std::string& name : splash_names())
      benchmark::RegisterBenchmark((name + at).c_str(), [=](benchmark::State& state) {
        const SplashMaterial material = splash_material("fine_sand");
        run(state, *splash_of(name, material), material.grain, speed);
      });
    benchmark::RegisterBenchmark(("table" + at).c_str(), [=](benchmark::State& state) {
      const Grain grain = splash_material("fine_sand").grain;
      run(state, TabulatedSplash(table(grain), grain), grain, speed);
    });
  }
  return 0;
}();

}  // namespace
}  // namespace aeolian
