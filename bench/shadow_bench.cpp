// From a photograph of 12 megapixels to a profile, on one thread. The photo is rendered once and in memory.
// `times_pass`: how many times as long as one pass over the photo's bytes, the least that any reader must do.

#include <cstdint>
#include <ctime>
#include <numeric>
#include <vector>

#include "rendering/shadow_scene.hpp"
#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace {

using namespace aeolian;

struct Subject {
  SetUp set_up;
  Photo photo;
};

/// The first random set-up with markers, or with two rows of marks.
const Subject& subject(bool markers) {
  static Subject subjects[2];
  Subject& chosen = subjects[markers ? 1 : 0];
  for (std::uint64_t seed = 1; chosen.photo.values8.empty(); ++seed) {
    chosen.set_up = random_set_up(seed, 12);
    if (chosen.set_up.setup.markers.has_value() == markers) chosen.photo = photograph(chosen.set_up.scene);
  }
  return chosen;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds_to_pass(const std::vector<std::uint8_t>& bytes) {
  constexpr int times = 20;
  const double start = processor_seconds();
  for (int i = 0; i < times; ++i)
    benchmark::DoNotOptimize(std::accumulate(bytes.begin(), bytes.end(), std::uint64_t{0}));
  return (processor_seconds() - start) / times;
}

void BM_PhotoToProfile(benchmark::State& state) {
  cv::setNumThreads(1);
  const Subject& s = subject(state.range(0) != 0);
  const double pass = seconds_to_pass(s.photo.values8);
  const double start = processor_seconds();
  for (auto _ : state) benchmark::DoNotOptimize(measure_shadow(s.photo, s.set_up.setup, ProfileMode::full));
  const double elapsed = (processor_seconds() - start) / static_cast<double>(state.iterations());
  state.counters["megapixels_per_s"] = 1e-6 * static_cast<double>(s.photo.values8.size()) / elapsed;
  state.counters["times_pass"] = elapsed / pass;
}
BENCHMARK(BM_PhotoToProfile)->ArgName("markers")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void BM_DecodeJpeg(benchmark::State& state) {
  const Photo& photo = subject(true).photo;
  const cv::Mat picture(photo.height_px, photo.width_px, CV_8U,
                        const_cast<std::uint8_t*>(photo.values8.data()));
  std::vector<std::uint8_t> file;
  cv::imencode(".jpg", picture, file, {cv::IMWRITE_JPEG_QUALITY, 92});
  for (auto _ : state) benchmark::DoNotOptimize(cv::imdecode(file, cv::IMREAD_GRAYSCALE));
}
BENCHMARK(BM_DecodeJpeg)->Unit(benchmark::kMillisecond);

void BM_AnalyseProfile(benchmark::State& state) {
  const Subject& s = subject(true);
  const ShadowProfile profile = measure_shadow(s.photo, s.set_up.setup, ProfileMode::full);
  for (auto _ : state) benchmark::DoNotOptimize(analyse(profile));
  state.counters["stations"] = static_cast<double>(profile.x.size());
}
BENCHMARK(BM_AnalyseProfile)->Unit(benchmark::kMillisecond);

}  // namespace
