// Analysing profiles of 1000 and 10 000 samples with all uncertainties.
// `times_copy`: how many times as long as copying the profile's positions, heights and errors, the least that
// any reader of it must do.

#include <cmath>
#include <cstring>
#include <ctime>

#include <benchmark/benchmark.h>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/surface/random.hpp"

namespace {

using aeolian::ShadowProfile;

/// Ripples of 7 cm in sand of 0.27 mm, with the noise of half a grain.
ShadowProfile rippled_bed(int samples) {
  constexpr double grain = 0.27e-3;
  aeolian::RandomStream random(1, 0);
  ShadowProfile profile;
  for (int i = 0; i < samples; ++i) {
    const double phase = 2 * M_PI * i * grain / 0.07;
    profile.x.push_back(i * grain);
    profile.z.push_back(0.002 * std::sin(phase - 0.5 * std::sin(phase)) + 0.5 * grain * random.normal());
    profile.sigma_z.push_back(0.5 * grain);
  }
  profile.grain_diameter = grain;
  profile.relative_sigma = 0.01;
  profile.scale = {8000, 20};
  return profile;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds_to_copy(const ShadowProfile& profile) {
  ShadowProfile copy = profile;
  constexpr int times = 20000;
  const double start = processor_seconds();
  for (int i = 0; i < times; ++i) {
    for (const auto& [to, from] :
         {std::pair(&copy.x, &profile.x), {&copy.z, &profile.z}, {&copy.sigma_z, &profile.sigma_z}})
      std::memcpy(to->data(), from->data(), from->size() * sizeof(double));
    benchmark::ClobberMemory();
  }
  return (processor_seconds() - start) / times;
}

void BM_Analyse(benchmark::State& state) {
  const ShadowProfile profile = rippled_bed(static_cast<int>(state.range(0)));
  const double copy = seconds_to_copy(profile);
  const double start = processor_seconds();
  for (auto _ : state) benchmark::DoNotOptimize(aeolian::analyse(profile));
  const double elapsed = (processor_seconds() - start) / static_cast<double>(state.iterations());
  state.counters["samples_per_s"] = static_cast<double>(profile.x.size()) / elapsed;
  state.counters["times_copy"] = elapsed / copy;
}
BENCHMARK(BM_Analyse)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
