#pragma once

#include <memory>

#include "aeolian_core/wind/gusts.hpp"
#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian {

/// The wind at a point.
struct ProbeReading {
  AirVelocity mean;              ///< [m/s]; up is the lift
  double friction_velocity = 0;  ///< of the turbulence there [m/s]
  double intensity = 0;          ///< standard deviation along the mean wind over its speed
  bool separated = false;        ///< in the air behind a lee, whose mean wind is not known: told as zero
};

/// Velocity, lift and turbulence at points of a map, for one wind.
///
/// The mean is the volume's. Turbulence is that of the surface layer (Kaimal's, section 6.4 of the wind spec)
/// for the friction velocity of the ground below within the inner layer, going over to that of the
/// surroundings above; in separated air it is at least theirs.
class WindProbe {
 public:
  /// `volume` may be null: the log law everywhere. `inner_depth` of the relief [m], positive.
  WindProbe(WindField field, std::unique_ptr<const WindVolume> volume, double roughness, double inner_depth);

  /// At a height over the ground [m]; not a number where the volume does not reach. Throws Error for a height
  /// that is not above the roughness length.
  ProbeReading at(MapPoint point, double height) const;
  /// Gusts there, whose `speed`, `height` and `friction_velocity` are the reading's. Throws Error where the
  /// mean wind is not known.
  Gusts gusts(MapPoint point, double height, double step, std::size_t samples, std::uint64_t seed) const;

 private:
  WindField field_;
  std::unique_ptr<const WindVolume> volume_;
  double roughness_;
  double inner_depth_;
};

}  // namespace aeolian
