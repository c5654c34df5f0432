#pragma once

#include "aeolian_core/wind/lee_bubble.hpp"
#include "aeolian_core/wind/relief_spectrum.hpp"
#include "aeolian_core/wind/terrain_response.hpp"
#include "aeolian_core/wind/upwind_profile.hpp"

namespace aeolian {

/// What is taken to be ground and what roughness, and when air separates.
struct ReliefSettings {
  double roughness = 1e-5;           ///< z0 [m]; it rises with saltation
  double shortest_wavelength = 0.5;  ///< what is shorter is roughness: ripples [m]
  bool periodic = false;             ///< the map repeats
  LeeBubble bubble;

  /// What is shorter lies within the roughness in any case [m].
  double shortest() const;
};

/// The stress of a wind over gentle relief by linear theory, wave by wave (Jackson & Hunt 1975; Weng et al.
/// 1991; Kroy, Sauermann & Herrmann 2002), over the streamlines that bound what separates in the lee of steep
/// slopes.
///
/// The stress peaks upwind of crests, by which dunes grow. Good for slopes up to 0.3.
class SpectralWind {
 public:
  /// Throws Error for settings that are not positive and finite.
  explicit SpectralWind(const ReliefSettings& settings);

  /// Of a wind that blows to `direction` [rad]. Throws Error without any known elevation, or for a direction
  /// that is not finite.
  TerrainResponse solve(const HeightMap& surface, double direction) const;
  /// The same of a relief that is at hand; nothing becomes unknown.
  TerrainResponse solve(const WindRelief& relief, double direction) const;

  const ReliefSettings& settings() const { return settings_; }

 private:
  ReliefSettings settings_;
};

}  // namespace aeolian
