#include "aeolian_core/wind/wind_probe.hpp"

#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr Require require("wind probe");

}  // namespace

WindProbe::WindProbe(WindField field, std::unique_ptr<const WindVolume> volume, double roughness,
                     double inner_depth)
    : field_(std::move(field)), volume_(std::move(volume)), roughness_(roughness), inner_depth_(inner_depth) {
  require(roughness > 0 && std::isfinite(roughness), "roughness length", roughness, "positive [m]");
  require(inner_depth > 0 && std::isfinite(inner_depth), "inner depth", inner_depth, "positive [m]");
}

ProbeReading WindProbe::at(MapPoint point, double height) const {
  require(height > roughness_ && std::isfinite(height), "height", height,
          fmt::format("above the roughness length, {:g} m", roughness_));
  ProbeReading reading;
  const double scale = field_.friction_velocity;
  if (volume_) {
    const AirVelocity wind = volume_->velocity(point.x, point.y, height);
    reading.mean = {scale * wind.east, scale * wind.north, scale * wind.up};
  } else {
    const double speed = log_law_speed(scale, height, roughness_);
    reading.mean = {speed * std::cos(field_.direction), speed * std::sin(field_.direction), 0};
  }
  double below = scale;
  const HeightMap& cells = field_.cells;
  if (cells.has("friction_velocity")) {
    const auto cell = cells.geometry().find(point.x, point.y);
    const std::size_t i = cell ? cells.geometry().index(*cell) : 0;
    below = cell ? static_cast<double>(cells.layer("friction_velocity")[i]) : NAN;
    const double speed = std::hypot(reading.mean.east, reading.mean.north);
    reading.separated = cell && cells.layer("separated")[i] > 0 && !(speed > 0);
    if (cell && cells.layer("separated")[i] > 0) below = scale;
  }
  const double near = std::exp(-height / inner_depth_);
  reading.friction_velocity = std::sqrt(scale * scale + near * (below * below - scale * scale));
  reading.intensity = kaimal_deviation(GustComponent::along) * reading.friction_velocity /
                      std::hypot(reading.mean.east, reading.mean.north);
  return reading;
}

Gusts WindProbe::gusts(MapPoint point, double height, double step, std::size_t samples,
                       std::uint64_t seed) const {
  const ProbeReading reading = at(point, height);
  const double speed = std::hypot(reading.mean.east, reading.mean.north);
  if (!(speed > 0))
    throw Error(fmt::format("gusts: at ({:g}, {:g}) m, {:g} m over the ground, the mean wind is not known",
                            point.x, point.y, height));
  return synthetic_gusts({speed, height, reading.friction_velocity, step, samples}, seed);
}

}  // namespace aeolian
