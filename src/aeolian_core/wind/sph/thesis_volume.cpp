#include "aeolian_core/wind/sph/thesis_volume.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/sph/resampled_flows.hpp"
#include "aeolian_core/wind/wall_law_response.hpp"

namespace aeolian {
namespace {

constexpr Require require("thesis' volume");
constexpr double sound_over_wind = 10;
constexpr double courant = 0.25;
constexpr int frames = 32;  ///< that a probe's mean is over, at the end

sph::ThesisSettings over_map(sph::ThesisSettings air, const GridGeometry& g, double direction) {
  require(air.wind > 0 && std::isfinite(air.wind), "wind", air.wind, "positive [m/s]");
  air.direction = direction;
  air.box = std::max(g.length_x(), g.length_y());
  air.sound = sound_over_wind * air.wind;
  air.step = courant * air.reach * air.box / air.side / (air.sound + air.wind);
  return air;
}

}  // namespace

ThesisVolume::ThesisVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
                           const ThesisVolumeSettings& settings)
    : relief_(relief), settings_(settings) {
  require(std::isfinite(direction), "direction", direction, "finite [rad]");
  require(settings.flow_throughs > 0 && settings.flow_throughs <= 100, "flow-throughs",
          settings.flow_throughs, "positive and at most 100");
  require(upwind.speed(settings.height) > 0, "height of the wind", settings.height,
          "above the roughness length [m]");
  const GridGeometry& g = relief.geometry;
  settings_.air = over_map(settings.air, g, direction);
  scale_ = settings_.air.wind / upwind.speed(settings.height);
  side_ = settings_.air.side;
  diameter_ = settings_.air.box / side_;
  top_ = settings_.air.box;
  place_.spacing = diameter_;
  place_.nx = place_.ny = side_ + 2 * settings_.air.reach;
  place_.x = g.origin_x() + 0.5 * (g.length_x() - place_.nx * diameter_);
  place_.y = g.origin_y() + 0.5 * (g.length_y() - place_.ny * diameter_);
  place_.floor = *std::min_element(relief.height.begin(), relief.height.end());
  sph::ThesisAir air(sph::AirGround(relief, place_), settings_.air);
  const double end = settings_.flow_throughs * settings_.air.box / settings_.air.wind;
  const auto steps = std::max<long>(frames, std::lround(end / settings_.air.step));
  cells_.resize(static_cast<std::size_t>(place_.nx * place_.ny * side_));
  for (long n = 0; n < steps; ++n) {
    air.step();
    if (n + frames < steps) continue;
    for (std::size_t i = 0; i < air.simulated(); ++i) {
      const auto z = static_cast<int>(air.height(i));
      if (z < 0 || z >= side_) continue;
      const int x = std::min(static_cast<int>(air.place()[i][0]), place_.nx - 1);
      const int y = std::min(static_cast<int>(air.place()[i][1]), place_.ny - 1);
      Cell& c = cells_[static_cast<std::size_t>((z * place_.ny + y) * place_.nx + x)];
      c.east += static_cast<double>(air.motion()[i][0]);
      c.north += static_cast<double>(air.motion()[i][1]);
      c.up += static_cast<double>(air.motion()[i][2]);
      ++c.count;
    }
  }
  limited_share_ = air.limited_share();
  const sph::AirGround ground(relief, place_);
  flows_ = sph::resampled_flows(
      g, diameter_, side_,
      [&](double x, double y) {
        return diameter_ * static_cast<double>(ground.height(static_cast<float>((x - place_.x) / diameter_),
                                                             static_cast<float>((y - place_.y) / diameter_)));
      },
      [&](double x, double y, double z) {
        const AirVelocity u = mean(x, y, z);
        return std::isfinite(u.up) ? u : AirVelocity{};
      });
}

AirVelocity ThesisVolume::mean(double x, double y, double height) const {
  const int ix = std::clamp(static_cast<int>((x - place_.x) / diameter_), 0, place_.nx - 1);
  const int iy = std::clamp(static_cast<int>((y - place_.y) / diameter_), 0, place_.ny - 1);
  const int iz = std::clamp(static_cast<int>(height / diameter_), 0, side_ - 1);
  const Cell& c = cells_[static_cast<std::size_t>((iz * place_.ny + iy) * place_.nx + ix)];
  if (!(c.count > 0)) return {NAN, NAN, NAN};
  const double by = 1 / (c.count * scale_);
  return {by * c.east, by * c.north, by * c.up};
}

AirVelocity ThesisVolume::velocity(double x, double y, double height) const {
  if (!relief_.geometry.find(x, y) || !(height <= top_)) return {NAN, NAN, NAN};
  if (height <= 0) return {};
  AirVelocity u = mean(x, y, height);
  if (settings_.lift_adjusted) u.up /= sph::ThesisAir::lift_divisor(height, settings_.air.wind, u.up >= 0);
  return u;
}

TerrainResponse thesis_response(const HeightMap& surface, double direction, const ReliefSettings& settings,
                                const ThesisVolumeSettings& thesis) {
  const WindRelief relief = wind_relief(surface, settings.shortest());
  const ThesisVolume volume(relief, direction, UpwindProfile::log_law(settings.roughness), thesis);
  return wall_law_response(surface, relief, volume, direction, settings, 0.5 * volume.diameter());
}

}  // namespace aeolian
