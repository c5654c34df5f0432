#pragma once

#include <functional>
#include <string>
#include <vector>

#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"
#include "aeolian_core/wind/wind_model.hpp"

namespace aeolian {

/// A surface at one time of a run.
struct ErosionMoment {
  double time = 0;        ///< [s]
  double deviation = 0;   ///< standard deviation of the depth on the ground, without its mean plane [m]
  double wavelength = 0;  ///< along the wind, of the peak of crests' mean spectrum [m]; NaN: none above noise
  double speed = 0;     ///< of the pattern along the wind since the moment before [m/s]; NaN: not to be told
  double bare = 0;      ///< share of the cells without a grain's depth of cover
  double sintered = 0;  ///< share of the cells whose surface is sintered snow
  double airborne = 0;  ///< volume in the air [m^3]
  double error = 0;     ///< volume unaccounted for so far, of that moved
};

struct ErosionHistory {
  std::vector<ErosionMoment> moments;
  VolumeBalance volume;
  ErosionCounts counts;
  double computing_time = 0;  ///< [s]
};

/// Wavelength along a direction of the depth on hard ground [m]: the peak of the spectrum weighted with
/// wavenumber, of profiles averaged over eight cells across it; NaN where that is longest or there is none.
double crest_wavelength(const GridGeometry& geometry, const HeightMap::Layer& elevation, double direction);

/// The wind that blows over a run: a model, what it is told, and after how many seconds it is asked again;
/// zero: once.
struct BlowingWind {
  WindModel& model;
  WindInput input;
  double every = 0;
};

/// Blows over a map with layers `elevation` and `ground` for `duration` [s] in `frames` equal parts;
/// `keep(map, frame)` is called at the beginning and after each, `progress(share)` too.
ErosionHistory run_erosion(HeightMap& map, ParticleErosion& model, const BlowingWind& wind,
                           const Grain& grain, double duration, int frames,
                           const std::function<void(const HeightMap&, int)>& keep,
                           const std::function<void(double)>& progress);

}  // namespace aeolian
