#include "aeolian_core/wind/sph/sph_volume.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/sph/resampled_flows.hpp"
#include "aeolian_core/wind/wall_law_response.hpp"

namespace aeolian {
namespace {

constexpr Require require("SPH volume");
constexpr int ring = 5;              ///< sites in which the wind is given, on each side
constexpr double blend = 0.15;       ///< of the map, around it, in which its border sinks to the ring's level
constexpr double least_blend = 3;    ///< sites
constexpr double reliefs_above = 4;  ///< air over the highest ground, in units of the relief
constexpr double least_height = 0.3;  ///< of the air over the map's length
constexpr int least_sites = 10;       ///< of the air over the highest ground
constexpr int thin_sites = 8;         ///< across a ridge without end
constexpr double resolved_wave = 4;   ///< spacings

struct Range {
  double low, high;
};
Range range_of(const WindRelief& relief) {
  const auto [low, high] = std::minmax_element(relief.height.begin(), relief.height.end());
  return {*low, *high};
}

sph::BoxPlace box_over(const WindRelief& relief, double across, float support) {
  const GridGeometry& g = relief.geometry;
  const bool thin_x = g.nx() == 1 && g.ny() > 1;
  const bool thin_y = g.ny() == 1 && g.nx() > 1;
  sph::BoxPlace box;
  box.spacing = std::max(g.length_x(), g.length_y()) / across;
  const Range heights = range_of(relief);
  const double rise = (heights.high - heights.low) / box.spacing;
  box.floor = heights.low;
  const auto side = std::max(least_blend, std::ceil(blend * across));
  const int across_ridge = std::max(thin_sites, static_cast<int>(std::ceil(3 * support)) + 1);
  const auto sites = [&](double length, bool thin) {
    return thin ? across_ridge
                : std::max(
                      static_cast<int>(std::ceil(length / box.spacing)) + 2 * (ring + static_cast<int>(side)),
                      across_ridge);
  };
  box.nx = sites(g.length_x(), thin_x);
  box.ny = sites(g.length_y(), thin_y);
  box.ring_x = thin_x ? 0 : ring;
  box.ring_y = thin_y ? 0 : ring;
  box.blend_x = box.blend_y = static_cast<float>(side);
  box.nz = static_cast<int>(std::ceil(
      rise + std::max({reliefs_above * rise, least_height * across, static_cast<double>(least_sites)})));
  box.x = g.origin_x() + 0.5 * (g.length_x() - box.nx * box.spacing);
  box.y = g.origin_y() + 0.5 * (g.length_y() - box.ny * box.spacing);
  return box;
}

}  // namespace

SphVolume::SphVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
                     const SphSettings& settings)
    : relief_(relief), upwind_(upwind) {
  require(std::isfinite(direction), "direction", direction, "finite [rad]");
  require(settings.across >= 8 && settings.across <= 200, "particles across the map", settings.across,
          "8 to 200");
  require(settings.flow_throughs > 0 && settings.flow_throughs <= 100, "flow-throughs",
          settings.flow_throughs, "positive and at most 100");
  require(settings.max_particles >= 5000, "number of particles", static_cast<double>(settings.max_particles),
          "5000 or more");
  double across = settings.across;
  do {
    place_ = box_over(relief, across, settings.air.support);
    across *= 0.93;
  } while (static_cast<std::size_t>(place_.nx) * static_cast<std::size_t>(place_.ny) *
                   static_cast<std::size_t>(place_.nz) >
               settings.max_particles &&
           across > 4);
  spacing_ = place_.spacing;
  // Relief shorter than some spacings would only be noise to the particles.
  const double sigma = 0.5 * resolved_wave * spacing_ * std::sqrt(2 * M_LN2) / (2 * M_PI);
  const GridGeometry& g = relief_.geometry;
  smooth(relief_.height, g.nx(), g.ny(), sigma / g.cell(), relief_.periodic);
  blow(direction, settings);
  resample();
}

void SphVolume::blow(double direction, const SphSettings& settings) {
  ground_ = std::make_unique<sph::AirGround>(relief_, place_);
  const double height = place_.nz * spacing_;
  scale_ = upwind_.speed(height);
  require(scale_ > 0, "height of the box", height, "above the roughness length");
  sph::Upwind upwind;
  upwind.east = static_cast<float>(std::cos(direction));
  upwind.north = static_cast<float>(std::sin(direction));
  if (upwind_.sheared()) {
    upwind.friction = static_cast<float>(1 / scale_);
    upwind.roughness = static_cast<float>(upwind_.roughness() / spacing_);
  }
  sph::SphAir air(*ground_, upwind, settings.air);
  particles_ = air.size();
  const int levels = std::max(2, place_.nz - static_cast<int>(std::ceil(ground_->highest())) - 1);
  top_ = levels * spacing_;
  mean_ = std::make_unique<sph::MeanAir>(air);
  const double length = std::max(place_.nx, place_.ny);
  const double end = settings.flow_throughs * length;
  double next = 0.5 * end;
  while (air.time() < end) {
    air.step();
    ++steps_;
    iterations_ += air.iterations();
    if (air.time() < next) continue;
    mean_->add(air);
    next = air.time() + 1;  // A spacing later it is other air.
  }
  guards_ = air.guards();
}

AirVelocity SphVolume::resolved(double x, double y, double height) const {
  const auto px = static_cast<float>((x - place_.x) / spacing_);
  const auto py = static_cast<float>((y - place_.y) / spacing_);
  const sph::Four u = mean_->at(px, py, static_cast<float>(height / spacing_));
  return {scale_ * static_cast<double>(u[0]), scale_ * static_cast<double>(u[1]),
          scale_ * static_cast<double>(u[2])};
}

AirVelocity SphVolume::velocity(double x, double y, double height) const {
  if (!relief_.geometry.find(x, y) || !(height <= top())) return {NAN, NAN, NAN};
  if (height <= 0 || height <= upwind_.roughness()) return {};
  if (!upwind_.sheared() || height >= reference_height()) return resolved(x, y, height);
  // Within the lowest particles by the law of the wall, along the ground.
  AirVelocity wind = resolved(x, y, reference_height());
  const double part = upwind_.speed(height) / upwind_.speed(reference_height());
  return {part * wind.east, part * wind.north, part * wind.up};
}

void SphVolume::resample() {
  const auto height = [&](double x, double y) {
    return spacing_ * static_cast<double>(ground_->height(static_cast<float>((x - place_.x) / spacing_),
                                                          static_cast<float>((y - place_.y) / spacing_)));
  };
  const auto wind = [&](double x, double y, double z) {
    if (!upwind_.sheared() || z >= reference_height()) return resolved(x, y, z);
    const double part = upwind_.speed(z) / upwind_.speed(reference_height());
    const AirVelocity u = resolved(x, y, reference_height());
    return AirVelocity{part * u.east, part * u.north, part * u.up};
  };
  flows_ = sph::resampled_flows(relief_.geometry, spacing_, static_cast<int>(std::lround(top_ / spacing_)),
                                height, wind);
}

TerrainResponse sph_response(const HeightMap& surface, double direction, const ReliefSettings& settings,
                             const SphSettings& solver) {
  const WindRelief relief = wind_relief(surface, settings.shortest());
  const SphVolume volume(relief, direction, UpwindProfile::log_law(settings.roughness), solver);
  return wall_law_response(surface, relief, volume, direction, settings, volume.reference_height());
}

}  // namespace aeolian
