#pragma once

#include "aeolian_core/measure/profile_analysis.hpp"

namespace aeolian {

/// The wavelength of the regular train of ripples that fits a profile best, along the bed [m]: a line, a wave
/// and its first overtone by least squares, with wavelengths from 3/4 to 4/3 of `guess` tried. Every part of
/// the profile counts, not the places of troughs alone, so it is the sharpest figure for even ripples. The
/// standard error is that of the fit, for residuals as alike among neighbours as they are found. NaN when the
/// profile is shorter than 1.2 of the shortest.
Figure train_wavelength(const EvenProfile& profile, double shortest, double longest);

}  // namespace aeolian
