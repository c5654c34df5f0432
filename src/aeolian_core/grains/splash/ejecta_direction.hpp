#pragma once

#include "aeolian_core/grains/splash/bed_view.hpp"

namespace aeolian {

/// An angle above the bed, forward from 0 to backward at pi, exponential with this mean [rad] and kept from 1
/// to 179 degrees, as Kok & Renno (2009, secs. 2.3.2 and 2.3.3) and their program COMSALT draw those of
/// rebounds (mean 40 degrees) and ejecta (50 degrees).
double draw_elevation(double mean, RandomStream& random);

/// A grain of the bed that leaves at this speed [m/s] and elevation [rad].
LeavingGrain ejected(const BedView& bed, double speed, double elevation);

/// Appends `count` grains of exponential speeds with this mean [m/s] and elevations of ejecta.
void eject(const BedView& bed, int count, double mean_speed, RandomStream& random,
           std::vector<LeavingGrain>& ejecta);

constexpr double mean_rebound_elevation = 40 * M_PI / 180;
constexpr double mean_ejecta_elevation = 50 * M_PI / 180;

}  // namespace aeolian
