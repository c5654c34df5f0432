#pragma once

#include <vector>

#include "aeolian_core/measure/directional_lines.hpp"

namespace aeolian {

/// How alike two surfaces are along the wind, wavelength by wavelength, whatever the shift between them.
struct Coherence {
  std::vector<double> wavelength;  ///< from the longest to two cells [m]
  std::vector<double> squared;     ///< magnitude-squared coherence, 0 to 1
  std::vector<double> sigma;       ///< its standard error (Bendat & Piersol 2010, eq. 9.81)
  std::vector<double> level95;     ///< what unrelated surfaces exceed in 5 % of the cases (Carter 1987, Proc.
                                   ///< IEEE 75, 236-255: 1 - 0.05^(1 / (n - 1)))
};

/// Coherence by Welch's method: segments of `segment` samples that overlap by half, under a Hann window, of
/// up to 64 lines evenly spaced; those with more than a tenth unknown in one of the surfaces are left out.
/// The number n of independent segments counts overlapping ones as 0.947 of as many (Welch 1967) and lines as
/// far as they differ at the wavelength: long crests make lines alike, and many of them then say no more than
/// one. Identical lines give exactly 1. Empty when fewer than two independent segments are left.
Coherence coherence(const DirectionalLines& a, const DirectionalLines& b, double cell, int segment);

}  // namespace aeolian
