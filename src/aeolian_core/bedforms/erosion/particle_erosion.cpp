#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"

#include <cstring>

#include "aeolian_core/bedforms/erosion/erosion_run.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

bool same_bits(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

bool same(const Grain& a, const Grain& b) {
  return a.diameter == b.diameter && a.density == b.density && a.porosity == b.porosity &&
         a.angle_of_repose == b.angle_of_repose;
}

ErosionCounts sum(const ErosionCounts& a, const ErosionCounts& b, int sign) {
  return {a.steps + sign * b.steps,       a.updates + sign * b.updates,         a.hops + sign * b.hops,
          a.launches + sign * b.launches, a.transported + sign * b.transported, a.slid + sign * b.slid};
}

}  // namespace

ParticleErosion::ParticleErosion(const ErosionParameters& parameters) : parameters_(parameters) {
  check(parameters_);
}

ParticleErosion::~ParticleErosion() = default;

ErosionRun& ParticleErosion::run_of(const HeightMap& map, const Grain& grain) {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (!run_ || map.geometry() != geometry_ || !same(grain, grain_) || !same_bits(elevation, left_)) {
    check(grain);
    run_ = std::make_unique<ErosionRun>(map, grain, parameters_);
    grain_ = grain;
    geometry_ = map.geometry();
  }
  return *run_;
}

template <class Advance>
BedChange ParticleErosion::change(HeightMap& map, const WindField& wind, const Grain& grain,
                                  Advance&& advance) {
  ErosionRun& run = run_of(map, grain);
  run.set_wind(wind);
  const std::int64_t units = run.units();
  const ErosionRun::Balance before = run.balance();
  const ErosionCounts counted = run.counts();
  time_ += advance(run);
  run.store(map);
  left_ = map.layer(layer::elevation);
  counts_ = sum(counts_, sum(run.counts(), counted, -1), 1);

  const double volume = run.bed().parcel_volume() / ErodibleBed::parcel_units;
  BedChange result{run.bed().take_changed(), {}};
  result.volume.moved = volume * static_cast<double>(run.balance().moved - before.moved);
  result.volume.change = volume * static_cast<double>(run.units() - units);
  result.volume.inflow = volume * static_cast<double>(run.balance().inflow - before.inflow);
  result.volume.outflow = volume * static_cast<double>(run.balance().outflow - before.outflow);
  return result;
}

BedChange ParticleErosion::advance(HeightMap& map, const Forcing& forcing, double duration) {
  check(forcing, duration);
  WindField wind;
  wind.friction_velocity = forcing.friction_velocity;
  wind.direction = forcing.direction;
  return advance(map, wind, forcing.grain, duration);
}

BedChange ParticleErosion::advance(HeightMap& map, const WindField& wind, const Grain& grain,
                                   double duration) {
  constexpr Require require{"erosion"};
  require(duration >= 0 && duration < 1e12, "duration", duration, "zero or more and finite");
  return change(map, wind, grain, [&](ErosionRun& run) { return run.advance(duration); });
}

BedChange ParticleErosion::iterate(HeightMap& map, const WindField& wind, const Grain& grain,
                                   std::int64_t steps) {
  if (steps < 0)
    throw Error("erosion: the number of steps is " + std::to_string(steps) + ", must not be negative");
  return change(map, wind, grain, [&](ErosionRun& run) { return run.iterate(steps); });
}

std::size_t ParticleErosion::airborne() const { return run_ ? run_->airborne() : 0; }

double ParticleErosion::airborne_volume() const {
  return run_ ? static_cast<double>(run_->airborne()) * run_->bed().parcel_volume() : 0;
}

}  // namespace aeolian
