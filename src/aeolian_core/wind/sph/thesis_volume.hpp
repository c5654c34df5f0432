#pragma once

#include "aeolian_core/wind/spectral_wind.hpp"
#include "aeolian_core/wind/sph/thesis_air.hpp"
#include "aeolian_core/wind/terrain_response.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian {

struct ThesisVolumeSettings {
  /// The length of the box becomes that of the map; of the speed of sound and of the step, which the thesis
  /// does not state, ten times the wind and a quarter of what sound takes for a support.
  sph::ThesisSettings air;
  double height = 10;         ///< at which the surroundings have the wind of `air` [m]
  double flow_throughs = 1;   ///< that the box is blown through
  bool lift_adjusted = true;  ///< (4.22), the divisor that the spec warns of
};

/// The thesis' wind over a map (Dobusch 2016), as it is: a plug of wind that comes in along the ground at
/// every height, probes that give the plain mean of the particles in their cell, a particle's diameter long,
/// lift divided by what was fitted. Not a number in a cell without particles. To show what it does, not to be
/// used: it has no log law and no stress at the wall, and unlike a neutral wind's its shape depends on the
/// speed.
class ThesisVolume : public WindVolume {
 public:
  /// Throws Error for settings that are not allowed.
  ThesisVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
               const ThesisVolumeSettings& settings);

  AirVelocity velocity(double x, double y, double height) const override;
  double top() const override { return top_; }
  const FaceFlows& flows() const override { return flows_; }
  double diameter() const { return diameter_; }  ///< of particles [m]
  /// Share of the particles that its limiter slowed in the last step.
  double limited_share() const { return limited_share_; }

 private:
  AirVelocity mean(double x, double y, double height) const;

  WindRelief relief_;
  ThesisVolumeSettings settings_;
  sph::BoxPlace place_;
  int side_;
  double diameter_, top_;
  double scale_;  ///< the wind's units in m/s
  double limited_share_ = 0;
  struct Cell {
    double east = 0, north = 0, up = 0, count = 0;
  };
  std::vector<Cell> cells_;
  FaceFlows flows_;
};

/// The stress that the law of the wall would have under it, and separated air as LeeBubble tells it.
TerrainResponse thesis_response(const HeightMap& surface, double direction, const ReliefSettings& settings,
                                const ThesisVolumeSettings& thesis);

}  // namespace aeolian
