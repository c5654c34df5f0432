#pragma once

#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/mean_splash.hpp"
#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// What drives a bed: the rain of saltating grains and what each does, averaged over the time to be advanced.
struct Forcing {
  double direction = 0;            ///< where the wind blows to, counter-clockwise from east [rad]
  double friction_velocity = 0;    ///< that drives it [m/s]; laws of the ripples' size ask for it
  double impact_angle = 0.17;      ///< mean, below the horizontal [rad]
  double impact_angle_spread = 0;  ///< standard deviation of the impact angles [rad]
  double ejection_rate = 0;        ///< grains set reptating per area and time on a flat bed [m^-2 s^-1]
  double reptation_length = 0;     ///< mean [m]
  Grain grain;

  /// K0, the depth of bed set moving per time on a flat bed [m/s]: ejection rate times volume per grain.
  double erosion_rate() const;
};

/// Throws Error naming the property of the forcing, or the duration [s], that is not physical, and what is
/// allowed.
void check(const Forcing& forcing, double duration);

/// The forcing of one saltation state.
Forcing make_forcing(const SaltationState& state, double direction, const Grain& grain,
                     const MeanSplash& splash);

/// The mean of several forcings (gusts) with the weight of each one's time: rates are averaged as they are,
/// direction and impact angle by ejection rate, so that calm spells move nothing. Throws Error when empty or
/// sizes differ.
Forcing mean_forcing(const std::vector<Forcing>& forcings, const std::vector<double>& weights);

/// Book-keeping of sand in one advance [m^3].
struct VolumeBalance {
  double moved = 0;   ///< set moving in all
  double change = 0;  ///< of the bed
  double inflow = 0;  ///< across the borders
  double outflow = 0;
  /// What is unaccounted for, relative to what moved; zero when nothing moved.
  double error() const { return moved > 0 ? (change - inflow + outflow) / moved : 0; }
};

/// What an advance did.
struct BedChange {
  TileMask active;  ///< tiles whose surface changed
  VolumeBalance volume;
};

/// Tiles in which a height differs; both have a value for each cell.
TileMask changed_tiles(const GridGeometry& geometry, const std::vector<double>& before,
                       const std::vector<double>& after);

/// One interface for every model that changes the surface.
class BedModel {
 public:
  virtual ~BedModel() = default;
  /// Moves the layer `elevation` of the map forward by `duration` [s]. Unknown cells stay unknown. Below the
  /// impact threshold (no ejection) the map is left bit for bit. Throws Error for a forcing or duration that
  /// is not physical.
  virtual BedChange advance(HeightMap& map, const Forcing& forcing, double duration) = 0;
};

}  // namespace aeolian
