#pragma once

#include <memory>

#include "aeolian_core/wind/spectral_wind.hpp"
#include "aeolian_core/wind/sph/mean_air.hpp"
#include "aeolian_core/wind/terrain_response.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian {

struct SphSettings {
  int across = 24;                    ///< particles along the longer side of the map, 8 to 200
  double flow_throughs = 3;           ///< that the box is blown through, of which the second half is averaged
  std::size_t max_particles = 60000;  ///< fewer along the map when there would be more
  sph::AirSettings air;
};

/// The box of SphAir over a whole map and, around it, over ground that sinks to the level of the ring where
/// the wind comes in at its true height: blown through until it is steady, then averaged over time.
///
/// What is shorter than four spacings of particles is not felt. Its resolution and its wall stress do not
/// lead the crest: it must not drive the growth of dunes.
class SphVolume : public WindVolume {
 public:
  /// Throws Error for settings that are not allowed.
  SphVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
            const SphSettings& settings);

  AirVelocity velocity(double x, double y, double height) const override;
  double top() const override { return top_; }
  /// Through boxes over the map as long, wide and high as the spacing of particles, that follow the ground.
  const FaceFlows& flows() const override { return flows_; }
  /// Height over the ground of the wind that tells its stress [m].
  double reference_height() const { return 1.5 * spacing_; }
  double spacing() const { return spacing_; }  ///< of particles [m]
  std::size_t particles() const { return particles_; }
  long steps() const { return steps_; }
  long iterations() const { return iterations_; }  ///< of the pressure, all steps together
  const sph::AirGuards& guards() const { return guards_; }

 private:
  void blow(double direction, const SphSettings& settings);
  void resample();
  AirVelocity resolved(double x, double y, double height) const;

  WindRelief relief_;
  UpwindProfile upwind_;
  sph::BoxPlace place_;
  double spacing_ = 1;
  double top_ = 0;
  double scale_ = 1;  ///< U in units of the upwind profile
  std::unique_ptr<sph::AirGround> ground_;
  std::unique_ptr<sph::MeanAir> mean_;
  FaceFlows flows_;
  std::size_t particles_ = 0;
  long steps_ = 0;
  long iterations_ = 0;
  sph::AirGuards guards_;
};

/// The stress of that wind by the law of the wall, and separated air behind steep lees as LeeBubble tells it.
TerrainResponse sph_response(const HeightMap& surface, double direction, const ReliefSettings& settings,
                             const SphSettings& solver);

}  // namespace aeolian
