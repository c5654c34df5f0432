#include "aeolian_twin/nodes/wind_prober.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/inner_layer.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double headroom = 1.2;

}  // namespace

std::vector<ProbeReading> WindProber::at(const std::vector<Eigen::Vector3d>& points) {
  if (!reader_.field()) throw Error("probes: there is no wind yet");
  const std::vector<double> heights = heights_of(points);
  double top = 0;
  for (const double height : heights)
    if (std::isfinite(height)) top = std::max(top, height);
  solve(top);
  const double scale = reader_.field()->friction_velocity;
  const double turn = wrap_angle(reader_.field()->direction - direction_);
  std::vector<ProbeReading> readings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ProbeReading reading{{nan, nan, nan}, nan, nan, false};
    if (heights[i] > reader_.roughness()) {
      reading = probe_->at({points[i].x(), points[i].y()}, heights[i]);
      const auto [east, north, up] = reading.mean;
      reading.mean = {scale * (std::cos(turn) * east - std::sin(turn) * north),
                      scale * (std::sin(turn) * east + std::cos(turn) * north), scale * up};
      reading.friction_velocity *= scale;
    }
    readings.push_back(reading);
  }
  return readings;
}

std::vector<Gusts> WindProber::gusts(const std::vector<Eigen::Vector3d>& points,
                                     const std::vector<ProbeReading>& readings, double step,
                                     std::size_t samples, std::uint64_t seed) const {
  const std::vector<double> heights = heights_of(points);
  std::vector<Gusts> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double speed = std::hypot(readings[i].mean.east, readings[i].mean.north);
    const GustSetting setting{speed, heights[i], readings[i].friction_velocity, step, samples};
    result.push_back(speed > 0 ? synthetic_gusts(setting, seed + i) : Gusts{step, {}, {}, {}});
  }
  return result;
}

/// Over the ground [m]; not a number for a point that is not finite.
std::vector<double> WindProber::heights_of(const std::vector<Eigen::Vector3d>& points) const {
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : points)
    heights.push_back(point.allFinite() ? point.z() - reader_.ground().at(point.x(), point.y()) : nan);
  return heights;
}

/// The volume is made for the middle of the field's sector, as the field is, and turned by what is left.
void WindProber::solve(double top) {
  const double sector = TerrainWindSettings().sector;
  const double direction = wrap_angle(sector * std::round(reader_.field()->direction / sector));
  TerrainWind& model = reader_.model();
  if (probe_ && model.solutions() == solutions_ && direction == direction_ && top <= top_) return;
  const HeightMap* map = reader_.ground().map();
  const double roughness = reader_.roughness();
  direction_ = direction;
  top_ = headroom * std::max(top, 100 * roughness);
  WindInput unit;
  unit.height = top_;
  unit.speed = log_law_speed(1, unit.height, roughness);
  unit.direction = direction;
  unit.time = reader_.time();
  WindField field = model.solve(unit, map);
  probe_ = std::make_unique<WindProbe>(std::move(field), map ? model.volume(*map, direction, top_) : nullptr,
                                       roughness, inner_depth_over(reader_.ground().extent(), roughness));
  solutions_ = model.solutions();
}

}  // namespace aeolian
