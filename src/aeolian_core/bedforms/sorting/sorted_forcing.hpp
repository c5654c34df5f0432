#pragma once

#include "aeolian_core/bedforms/bed_model.hpp"

namespace aeolian {

/// What drives a bed of two sizes of grains: one rain of saltating grains, and what it does to a bed of
/// either size alone. On a mixed bed each size is struck by the share of the surface that it takes.
struct SortedForcing {
  Forcing fine;
  Forcing coarse;
};

/// Throws Error naming the property of either forcing, or the duration [s], that is not physical, and sizes
/// that are not in order or do not share one wind.
void check(const SortedForcing& forcing, double duration);

/// The forcing of a mixed bed by the rain that the forcing of its fine grains tells: saltating grains are
/// taken to be fine, whatever lies on the bed.
///
/// An impact shakes an area of bed that depends on the impact alone, so that the number of grains that it
/// sets moving goes with 1 / d^2 (an assumption; Kok & Renno 2009, eq. 12, have 1 / d). It hands the bed a
/// fixed part of its momentum (Kok & Renno 2009), so speeds go with 1 / d (that they fall with the size is in
/// Feng, Li & Ni 2009) and reptation lengths, which are ballistic, with 1 / d^2, but no grain hops less than
/// its own diameter. Depth set moving goes with d, flux with 1 / d. For grains of one size both forcings are
/// the same. Throws Error for a coarse diameter below the fine one.
SortedForcing sorted_forcing(const Forcing& fine, double coarse_diameter);

/// The same for a steady wind of so much friction velocity [m/s]; see steady_saltation and MeanSplash.
SortedForcing sorted_forcing(double friction_velocity, double direction, const Grain& fine,
                             double coarse_diameter, const MeanSplash& splash = {});

}  // namespace aeolian
