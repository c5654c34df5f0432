#pragma once

#include "aeolian_core/bedforms/theory/triangular_ripple.hpp"

namespace aeolian {

/// When colliding ripples merge, and how far that lets their wavelength grow (Werner 1987, sec. V and fig.
/// 5.24; specification sec. 4).

/// The effective height [m] below which a shadow, from apex to the meeting with the next stoss, is shorter
/// than the reptation length [m]: grains overshoot it, the ripple loses them for good, and the pair merges.
double overshoot_height(double reptation_length, double impact_angle);

/// The effective height [m] below which chance shears off the flattened apex: 0.23 cm for grains of 0.1 cm.
/// The thesis gives no derivation; in grain diameters it is an input.
constexpr double shearing_height(double grain_diameter) { return 2.3 * grain_diameter; }

/// Least effective height in a collision, in parts of the smaller ripple's height: the mean over target and
/// brink ejection. `ratio` of the heights as in `collide`.
double mean_least_effective_height(double ratio);

/// Ripples that just merge.
struct LimitingWavelength {
  double smaller;  ///< of the upstream ripple [m]
  double larger;   ///< of the downstream ripple [m]
  /// Of the ripple they become, which has the cross-section of both [m].
  double merged() const;
};

/// The largest pair of a ratio of heights that merges, when it does so below an effective height [m].
LimitingWavelength limiting_wavelength(const TriangularRipple& shape, double ratio, double effective_height);

/// What moves one ripple by its own wavelength, and by how much chance makes that vary (specification sec. 4,
/// fluctuation budget).
struct FluctuationBudget {
  double speed;     ///< [m/s]
  double period;    ///< in which it moves a wavelength [s]
  double impacts;   ///< on its stoss in that time
  double relative;  ///< standard deviation of the distance, in parts of the wavelength
};

/// A ripple of a strip of `width` [m], triangular with half of its wavelength lit.
struct RippleStrip {
  double wavelength;      ///< [m]
  double index;           ///< wavelength / height
  double width;           ///< [m]
  double grain_diameter;  ///< effective [m]
};
/// `impact_rate` [m^-2 s^-1], and the reptation length summed over all grains that an impact moves [m].
FluctuationBudget fluctuation_budget(const RippleStrip& ripple, double impact_rate, double total_reptation);

}  // namespace aeolian
