#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/atmosphere.hpp"

namespace aeolian {

class ErodibleBed;

/// Parcels in the air, one array for each property. Places are in cells from the centre of cell (0, 0),
/// heights in metres above the bed's datum, velocities in m/s.
struct Parcels {
  std::vector<float> x, y, z, vx, vy, vz;
  std::vector<float> clearance;     ///< above the surface at the beginning of the last step [m]
  std::vector<std::uint64_t> name;  ///< the same for all of a parcel's life; random numbers depend on it
  std::vector<std::uint32_t> hop;   ///< counted from its lift-off

  std::size_t size() const { return x.size(); }
  void add(float px, float py, float pz, float u, float v, float w, std::uint64_t its_name);
  /// The last one takes the place of this one.
  void remove(std::size_t i);
};

/// What a step through the air needs to know, in floats.
struct ParcelStep {
  const float* surface;  ///< as in ErodibleBed
  std::int32_t stride;
  /// Friction velocity over von Karman's constant, east and north [m/s]: of each place of the surface, or the
  /// same everywhere where that is null.
  const float* shear;
  float uniform_shear_x, uniform_shear_y;
  float per_roughness;  ///< 1 / z0 [1/m]
  float drag;           ///< acceleration by drag = drag * (c_d Re) * relative velocity [1/s]
  float reynolds;       ///< of a relative speed of 1 m/s
  float gravity, step, per_cell;
  float period_x, period_y;  ///< in cells; zero: open
  float wrap_x, wrap_y;      ///< from where places are wrapped; infinite: open
  float last_x, last_y;      ///< of places that can be looked up
};

/// The constants of a grain, an air and a bed; without wind.
ParcelStep flight_step(const ErodibleBed& bed, const Grain& grain, const Atmosphere& air, double roughness,
                       double step);

/// Moves the parcels [begin, end) by a step: gravity to second order, drag implicitly, each with the full
/// relative velocity in the logarithmic wind over the surface below it (specification sec. 2.4). Those below
/// the surface, whose clearance is then not positive, stay as they are. Periodic places are wrapped.
void fly(Parcels& parcels, std::size_t begin, std::size_t end, const ParcelStep& step);

}  // namespace aeolian
