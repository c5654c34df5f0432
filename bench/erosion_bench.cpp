/// Speed of erosion by parcels: updates in full flight against the thesis' case and against a plain copy of
/// as many bytes, hops by table, larger maps, a thin cover; error against run time over step and table.

#include <cmath>

#include "copy_speed.hpp"
#include "erosion_rows.hpp"
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "aeolian_core/bedforms/erosion/hop_table.hpp"

namespace aeolian {
namespace {

HeightMap level_sand(int n, double cover = 1, double depth = 0.01) {
  HeightMap map(GridGeometry(0, 0, 0.005, n, n));
  map.add(layer::ground, 0);
  lay_sand(map, depth, 1);
  for (int y = static_cast<int>(cover * n); y < n; ++y)
    for (int x = 0; x < n; ++x) map.layer(layer::elevation)[map.geometry().index(x, y)] = 0;
  return map;
}

/// The thesis' case, 200 000 parcels on 256 x 256 cells, a third in the air: 100 iterations in full flight.
/// Arguments: cells along a side, threads.
void full_flight(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  HeightMap map = level_sand(static_cast<int>(state.range(0)));
  ParticleErosion model(thesis_erosion());
  model.iterate(map, wind_at_ten_metres(10), thesis_sand(), 400);
  const std::int64_t before = model.counts().updates;
  for (auto _ : state) model.iterate(map, wind_at_ten_metres(10), thesis_sand(), 100);
  const auto updates = static_cast<double>(model.counts().updates - before);
  state.counters["updates"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  // Seven floats of a parcel are read and written.
  constexpr double bytes = 2 * 7 * sizeof(float);
  static const double copy = bench::seconds_to_copy_a_byte();
  state.counters["of_copying"] = benchmark::Counter(updates * bytes / 2 * copy, benchmark::Counter::kIsRate);
  state.counters["in_the_air"] = static_cast<double>(model.airborne());
}
BENCHMARK(full_flight)
    ->Args({256, 1})
    ->Args({256, 2})
    ->Args({512, 1})
    ->Args({1024, 1})
    ->Args({2048, 1})
    ->Args({2048, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Ten seconds of wind by hop tables. Arguments: cells along a side, threads, per cent of cover, its depth
/// [mm]: its edge is a cliff.
void hop_tables(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  HeightMap map = level_sand(static_cast<int>(state.range(0)), static_cast<double>(state.range(2)) / 100,
                             static_cast<double>(state.range(3)) / 1000);
  ErosionParameters p;
  p.flight = FlightMode::hop_table;
  p.bounce.law = BounceLaw::measured;
  ParticleErosion model(p);
  model.advance(map, wind_at_ten_metres(12), thesis_sand(), 1);
  const std::int64_t before = model.counts().hops;
  for (auto _ : state) model.advance(map, wind_at_ten_metres(12), thesis_sand(), 10);
  state.counters["hops_a_minute"] =
      benchmark::Counter(60 * static_cast<double>(model.counts().hops - before), benchmark::Counter::kIsRate);
}
BENCHMARK(hop_tables)
    ->Args({256, 1, 100, 10})
    ->Args({256, 2, 100, 10})
    ->Args({256, 1, 10, 10})
    ->Args({256, 1, 100, 75})
    ->Args({256, 1, 10, 75})
    ->Args({1024, 1, 100, 10})
    ->Args({1024, 1, 10, 10})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// A wind below the threshold costs nothing but the comparison of the map.
void calm(benchmark::State& state) {
  HeightMap map = level_sand(1024);
  ParticleErosion model(ErosionParameters{});
  model.advance(map, wind_at_ten_metres(5), thesis_sand(), 1);
  for (auto _ : state) model.advance(map, wind_at_ten_metres(5), thesis_sand(), 3600);
}
BENCHMARK(calm)->Unit(benchmark::kMillisecond);

HopWind golden_wind() {
  return {friction_velocity(10, 10, 5e-6), 5e-6, thesis_sand(), Atmosphere{1.225, 1.5e-5, 9.81}};
}

/// A golden hop; the argument is the step in microseconds.
void step(benchmark::State& state) {
  const double exact = flown_hop(golden_wind(), 0.414, 0.414, 1e-6).range;
  double range = 0;
  for (auto _ : state)
    range = flown_hop(golden_wind(), 0.414, 0.414, 1e-6 * static_cast<double>(state.range(0))).range;
  state.counters["error_%"] = 100 * (range / exact - 1);
}
BENCHMARK(step)->RangeMultiplier(4)->Range(16, 16384)->Unit(benchmark::kMicrosecond);

/// Building a table of hops; the argument is its nodes each way. Worst error of the range.
void table_nodes(benchmark::State& state) {
  const auto nodes = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(HopTable(golden_wind(), 4, 1.5, nodes));
  const HopTable table(golden_wind(), 4, 1.5, nodes);
  RandomStream random(1, 0);
  double worst = 0;
  for (int n = 0; n < 200; ++n) {
    const double along = 3.9 * random.uniform();
    const double up = 0.05 + 1.4 * random.uniform();
    const double exact = flown_hop(golden_wind(), along, up, 5e-5).range;
    worst = std::max(worst,
                     std::abs(table.at(static_cast<float>(along), static_cast<float>(up)).range / exact - 1));
  }
  state.counters["worst_error_%"] = 100 * worst;
}
BENCHMARK(table_nodes)->RangeMultiplier(2)->Range(5, 80)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aeolian
