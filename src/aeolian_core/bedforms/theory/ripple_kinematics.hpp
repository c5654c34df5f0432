#pragma once

#include <vector>

namespace aeolian {

/// How moving sand shapes and shifts a bed: Werner (1987), eqs. 5.3-5.7, for profiles along the wind. A flux
/// q is a volume of bed per width and time [m^2/s]: Werner's R grains per time in a slice one grain thick,
/// times d^2. A flat bed is eroded at K0 = d^2 F_x [m/s], as in `Forcing::erosion_rate`.

/// h = q / speed + base (eq. 5.5), which holds for a ripple that keeps its shape while it moves.
struct MovingShape {
  double speed;          ///< [m/s]
  double base;           ///< [m]
  double determination;  ///< r^2 of the straight line; 1 when the shape is kept exactly
};

/// The straight line of least squares through heights [m] over fluxes [m^2/s] at the same places. Throws
/// Error when their numbers differ, are below three, or the fluxes are all the same.
MovingShape fit_translation(const std::vector<double>& height, const std::vector<double>& flux);

/// The flux [m^2/s] between samples `spacing` [m] apart that turns one profile [m] into the other within
/// `duration` [s], averaged over both sides of a sample and zero upwind of the first: eq. 5.3 read backwards.
/// Throws Error when their numbers differ.
std::vector<double> flux_between(const std::vector<double>& before, const std::vector<double>& after,
                                 double spacing, double duration);

/// Impacts per horizontal length on a slope, relative to a flat bed, for impacts at an angle below the
/// horizontal [rad]: eq. 5.6 without its root, which is for lengths along the slope. Zero where the slope
/// falls away more steeply than the impacts; what a crest upwind shades is for `exposure_periodic` to say.
double impact_ratio(double tan_slope, double impact_angle);

/// D of dh/dt = D d^2h/dx^2 [m^2/s] for a bed that varies little over the reptation length [m] (eqs. 5.4,
/// 5.6): negative, so slopes grow, and the faster the shorter they are.
double bed_diffusivity(double erosion_rate, double reptation_length, double impact_angle);

/// Growth rate [1/s] of a wave of wavenumber k [1/m] where each grain hops just the reptation length [m]: -D
/// k^2 for long waves, less for short ones (specification sec. 5.4).
double growth_rate(double erosion_rate, double reptation_length, double impact_angle, double wavenumber);

}  // namespace aeolian
