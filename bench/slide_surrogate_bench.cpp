/// How long a query of the shipped surrogate takes, of each kernel, over the 5 microseconds that were asked
/// for.

#include <benchmark/benchmark.h>

#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"

namespace aeolian {
namespace {

constexpr double asked = 5e-6;  ///< [s]

void query(benchmark::State& state, SvrKernel kernel) {
  SlideSurrogate::Settings settings;
  settings.kernel = kernel;
  settings.grid = {{0.01}, {1}, {10}, {0.1}};  // narrow: the most vectors
  const auto surrogate =
      SlideSurrogate::train(read_pile_table(AEOLIAN_REPOSITORY "/config/slide/piles_2d.csv"), settings);
  PileQuery pile{1.5, 1.5, 0.8, 0.05, 2};
  for (auto _ : state) {
    benchmark::DoNotOptimize(pile);
    benchmark::DoNotOptimize(surrogate.predict(pile));
  }
  state.counters["of what was asked"] =
      benchmark::Counter(asked * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(query, rbf, SvrKernel::rbf);
BENCHMARK_CAPTURE(query, linear, SvrKernel::linear);

/// A query that the hull has to be solved for: a table whose corners are missing.
void query_in_a_general_hull(benchmark::State& state) {
  PileTable table = read_pile_table(AEOLIAN_REPOSITORY "/config/slide/piles_2d.csv");
  PileTable inner;
  for (const PileRecord& r : table)
    if (r.run >= 4) inner.push_back(r);
  std::vector<PileFeatures> features;
  for (const PileRecord& r : inner) features.push_back(features_of(r.query));
  const ConvexHull hull(features);
  PileFeatures at = features_of({1.2, 2, 0.85, 0.05, 2});
  for (auto _ : state) {
    benchmark::DoNotOptimize(at);
    benchmark::DoNotOptimize(hull.contains(at));
  }
  state.counters["of what was asked"] =
      benchmark::Counter(asked * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(query_in_a_general_hull);

}  // namespace
}  // namespace aeolian
