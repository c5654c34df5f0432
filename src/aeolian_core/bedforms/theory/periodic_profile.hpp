#pragma once

#include <vector>

namespace aeolian {

/// Mean wavelength of a periodic profile of heights a `spacing` apart, in its unit: one over the mean
/// wavenumber, weighted with the power spectrum. Throws Error for fewer than four heights or a flat profile.
double mean_wavelength(const std::vector<double>& height, double spacing);

/// Angle [rad] below which a share of the slopes lies that rise from one height of a periodic profile to the
/// next, in the unit of `spacing`; 0 where none rises.
double upslope_quantile(const std::vector<double>& height, double spacing, double share);

}  // namespace aeolian
