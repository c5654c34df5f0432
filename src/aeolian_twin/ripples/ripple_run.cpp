#include "aeolian_twin/ripples/ripple_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

void add(const VolumeBalance& more, VolumeBalance& sum) {
  sum.moved += more.moved;
  sum.change += more.change;
  sum.inflow += more.inflow;
  sum.outflow += more.outflow;
}

void require_positive(const char* what, double seconds) {
  if (!(seconds > 0) || !std::isfinite(seconds))
    throw Error(fmt::format("ripple run: {} is {:g} s, must be positive", what, seconds));
}

/// Speed of the pattern between two maps; a pattern that repeats tells shifts of less than half of itself.
double pattern_speed(const GridGeometry& geometry, const HeightMap::Layer& before,
                     const HeightMap::Layer& after, double direction, double wavelength, double duration) {
  if (!std::isfinite(wavelength)) return unknown;
  const std::optional<double> shift =
      pattern_displacement(geometry, before, after, direction, 0.5 * wavelength);
  return shift ? *shift / duration : unknown;
}

}  // namespace

HeightMap screeded_bed(const GridGeometry& geometry, const Grain& grain, std::uint64_t seed) {
  check(grain);
  const double grains_across = std::max(1.0, geometry.cell() / grain.effective_diameter());
  const double sigma = grain.diameter / std::sqrt(12.0) / grains_across;
  RandomStream random(seed, 0);
  HeightMap map(geometry);
  for (float& height : map.add(layer::elevation, 0)) height = static_cast<float>(sigma * random.normal());
  return map;
}

RippleRun run_ripples(HeightMap& map, BedModel& model, const RippleRunSettings& settings,
                      const std::function<void(const HeightMap&, double)>& keep,
                      const std::function<void(double)>& progress) {
  require_positive("the duration", settings.duration);
  require_positive("the time between statistics", settings.statistics_every);
  require_positive("the time between maps", settings.map_every);
  const double direction = settings.forcing.direction;
  RippleRun run;
  const auto observe = [&](double time, double speed) {
    run.moments.push_back({time, ripple_statistics(map.geometry(), map.layer(layer::elevation), direction),
                           speed, run.volume.error()});
  };
  observe(0, unknown);
  keep(map, 0);
  double time = 0;
  for (std::int64_t observed = 1, kept = 1; time < settings.duration;) {
    const double next_observed =
        std::min(static_cast<double>(observed) * settings.statistics_every, settings.duration);
    const double next_kept = std::min(static_cast<double>(kept) * settings.map_every, settings.duration);
    const double next = std::min(next_observed, next_kept);
    const HeightMap::Layer before = map.layer(layer::elevation);
    const auto start = std::chrono::steady_clock::now();
    add(model.advance(map, settings.forcing, next - time).volume, run.volume);
    run.computing_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (next == next_observed) {
      observe(next, pattern_speed(map.geometry(), before, map.layer(layer::elevation), direction,
                                  run.moments.back().ripples.wavelength, next - time));
      ++observed;
    }
    if (next == next_kept) {
      keep(map, next);
      ++kept;
    }
    time = next;
    progress(time / settings.duration);
  }
  return run;
}

}  // namespace aeolian
