#include "learning_day.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"
#include "aeolian_core/measure/virtual_anemometer.hpp"
#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr double wind_rate = 2;     // [Hz]
constexpr double bed_step = 1;      // the bed advances under the mean wind of so long [s]
constexpr double spacing = 0.0008;  // of the lattice's columns [m]

std::string name_of(double time) { return fmt::format("elevation_{:04.0f}", time); }

/// What is random about a day as a whole.
struct Weather {
  VirtualAnemometer anemometer;
  double turn;     ///< of the wind over the day [rad]
  double spin_up;  ///< [s]

  explicit Weather(std::uint64_t seed) {
    RandomStream random(seed, 7);
    const double friction = 0.38 + 0.12 * random.uniform();
    anemometer.mean_speed =
        log_law_speed(friction, anemometer.height, grain_roughness(learning_grain().diameter));
    anemometer.direction_sigma = 4 * degree;
    turn = (random.uniform() - 0.5) * 40 * degree;
    spin_up = 300 + 300 * random.uniform();
  }

  std::vector<WindSample> wind(std::uint64_t seed) const {
    std::vector<WindSample> samples;
    for (const auto& s : anemometer.record(LearningDay::duration, wind_rate, seed)) {
      WindSample sample;
      sample.time = s.time;
      sample.friction_velocity =
          friction_velocity(s.speed, anemometer.height, grain_roughness(learning_grain().diameter));
      sample.direction = s.direction + turn * (s.time / LearningDay::duration - 0.5);
      samples.push_back(sample);
    }
    return samples;
  }
};

Forcing forcing_of(const WindSample& wind) {
  return make_forcing(steady_saltation(wind.friction_velocity, learning_grain()), wind.direction,
                      learning_grain(), MeanSplash{});
}

Forcing forcing_between(const std::vector<WindSample>& wind, double from, double to) {
  std::vector<Forcing> forcings;
  for (const WindSample& sample : wind)
    if (sample.time >= from - 1e-6 && sample.time < to - 1e-6) forcings.push_back(forcing_of(sample));
  return mean_forcing(forcings, std::vector<double>(forcings.size(), 1.0));
}

void make_day(std::uint64_t seed, const Weather& weather, LearningDay& day) {
  const auto columns = [](double length) { return 2 * static_cast<int>(std::lround(length / spacing / 2)); };
  LatticeBed bed(columns(day.plot.length_x()), columns(day.plot.length_y()), spacing,
                 learning_grain().angle_of_repose, seed);
  bed.advance(forcing_between(day.wind, 0, 60), weather.spin_up);
  for (double time = 0;; time += bed_step) {
    if (std::fmod(time, LearningDay::period) == 0) day.surface.push_back(bed.elevation(day.plot));
    if (time == LearningDay::duration) break;
    bed.advance(forcing_between(day.wind, time, time + bed_step), bed_step);
  }
}

}  // namespace

Grain learning_grain() {
  Grain grain;
  grain.diameter = 0.0004;
  return grain;
}

LearningDay learning_day(std::uint64_t seed, const std::string& folder) {
  const Weather weather(seed);
  LearningDay day;
  day.plot = GridGeometry(0, 0, 0.002, 256, 128);
  day.wind = weather.wind(seed);
  const std::string path = fmt::format("{}/day_{}_every_{:.0f}_s.tif", folder, seed, LearningDay::period);
  if (std::filesystem::exists(path)) {
    const HeightMap kept = read_geotiff(path);
    for (const std::string& name : kept.names()) day.surface.push_back(kept.layer(name));
    return day;
  }
  make_day(seed, weather, day);
  HeightMap map(day.plot);
  for (std::size_t i = 0; i < day.surface.size(); ++i)
    map.add(name_of(LearningDay::period * static_cast<double>(i)), day.surface[i]);
  make_directory(folder);
  write_geotiff(map, path);
  return day;
}

}  // namespace aeolian
