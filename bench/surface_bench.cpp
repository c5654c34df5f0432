// The walks over whole maps and clouds that every run makes: reading text clouds, resampling, hill shading,
// finding what has changed.
// `times_copy`: how many times as long as copying the bytes that must be read, the least that any such walk
// must do.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/held_map.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/surface/unseen_changes.hpp"

namespace {

using aeolian::GridGeometry;
using aeolian::HeightMap;
using Clock = std::chrono::steady_clock;

constexpr int side = 2000;

double seconds_to_copy(std::size_t bytes) {
  const std::vector<char> from(bytes, 'x');
  std::vector<char> to(bytes);
  constexpr int times = 20;
  const auto start = Clock::now();
  for (int i = 0; i < times; ++i) {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::ClobberMemory();
  }
  return std::chrono::duration<double>(Clock::now() - start).count() / times;
}

/// Measures a walk over so many items of so many bytes in all.
template <class Walk>
void measure(benchmark::State& state, std::size_t items, std::size_t bytes, Walk walk) {
  const double copy = seconds_to_copy(bytes);
  const auto start = Clock::now();
  for (auto _ : state) benchmark::DoNotOptimize(walk());
  const double once =
      std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(state.iterations());
  state.counters["items_per_s"] = static_cast<double>(items) / once;
  state.counters["times_copy"] = once / copy;
}

HeightMap rough_map() {
  HeightMap map(GridGeometry(0, 0, 0.002, side, side));
  aeolian::RandomStream random(1, 0);
  for (float& z : map.add(aeolian::layer::elevation)) z = static_cast<float>(0.001 * random.normal());
  return map;
}

void read_text_cloud(benchmark::State& state) {
  const auto path =
      (std::filesystem::temp_directory_path() / ("surface_bench_" + std::to_string(::getpid()) + ".xyz"))
          .string();
  aeolian::PointCloud cloud;
  cloud.origin_x = 512345;
  cloud.origin_y = 5401234;
  aeolian::RandomStream random(1, 0);
  const auto millimetres = [&] { return static_cast<float>(std::round(1e5 * random.uniform()) / 1000); };
  for (int i = 0; i < 500000; ++i) cloud.push_back(millimetres(), millimetres(), millimetres());
  aeolian::write_cloud(cloud, path);
  measure(state, cloud.size(), std::filesystem::file_size(path), [&] { return aeolian::read_cloud(path); });
  std::filesystem::remove(path);
}

void resample(benchmark::State& state, double cell, int cells) {
  const HeightMap map = rough_map();
  const GridGeometry target(0, 0, cell, cells, cells);
  const std::size_t larger = std::max(target.size(), map.geometry().size());
  measure(state, larger, larger * sizeof(float), [&] { return aeolian::resample(map, target); });
}

void hill_shade(benchmark::State& state) {
  const HeightMap map = rough_map();
  const HeightMap::Layer& elevation = map.layer(aeolian::layer::elevation);
  measure(state, elevation.size(), elevation.size() * sizeof(float),
          [&] { return aeolian::hill_shade(map.geometry(), elevation); });
}

/// All tiles of 1000 x 1000 cells touched, none or all of them notably changed.
void unseen_changes(benchmark::State& state, float step) {
  const GridGeometry grid(0, 0, 0.002, 1000, 1000);
  HeightMap map(grid);
  HeightMap::Layer& elevation = map.add(aeolian::layer::elevation, 0);
  map.add(aeolian::layer::variance, 1e-6F);
  aeolian::UnseenChanges unseen(grid);
  const aeolian::TileMask touched(grid, true);
  unseen.take(map, touched);
  for (float& z : elevation) z += step;
  HeightMap back = map;
  std::fill(back.layer(aeolian::layer::elevation).begin(), back.layer(aeolian::layer::elevation).end(), 0.0F);
  bool there = true;
  measure(state, grid.size(), 4 * grid.size() * sizeof(float), [&] {
    there = !there;
    return unseen.take(there ? back : map, touched);
  });
}

void differing_tiles(benchmark::State& state) {
  const HeightMap map = rough_map();
  const HeightMap same = map;
  measure(state, map.geometry().size(), 2 * map.geometry().size() * sizeof(float), [&] {
    return aeolian::differing_tiles(map, {0, side, 0, side}, same);
  });
}

BENCHMARK(read_text_cloud)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(resample, half_the_cell, 0.001, 2 * side)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(resample, two_and_a_half_cells, 0.005, side * 2 / 5)->Unit(benchmark::kMillisecond);
BENCHMARK(hill_shade)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(unseen_changes, none_notable, 0.0004F)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(unseen_changes, all_notable, 0.0006F)->Unit(benchmark::kMillisecond);
BENCHMARK(differing_tiles)->Unit(benchmark::kMillisecond);

}  // namespace
