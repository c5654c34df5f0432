#pragma once

#include <cstdint>

#include "aeolian_core/bedforms/height_map/impact_sweep.hpp"

namespace aeolian {

struct Forcing;

/// What comes in over open borders from upwind.
enum class Inflow {
  flat_bed,  ///< as from a flat bed; ripples drift away from the border and leave it bare
  none,      ///< nothing: there is no sand upwind
  ripples,   ///< as from a bed with ripples that grow fastest: a random train of them, of that mean
};

/// The supply at some time [s] since a run began, null for a flat bed's. `wavelength` [m] and `frequency`
/// [rad/s] are those of the ripples that come in; `cell` [m]. All of it times `share`.
ImpactSweep::Supply border_supply(Inflow inflow, double wavelength, double frequency, double cell,
                                  double time, std::uint64_t seed, double share = 1);

/// The width along open borders of what a model cannot know, for want of what lies upwind [m]: the longest
/// shadow of crests that rise `relief` [m] above the troughs, and at least five reptation lengths
/// (specification sec. 9, 23). Scores should leave it out; crests carry it downwind at their speed besides.
double polluted_margin(const Forcing& forcing, double relief);

}  // namespace aeolian
