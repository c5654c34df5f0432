#pragma once

#include <optional>

#include "aeolian_core/measure/ripple_crests.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// What the crests of one map say of its ripples. Standard errors are those of a mean (median) of as many
/// independent sections as the crests are wavelengths long; NaN where nothing can be told.
struct RippleField {
  Figure wavelength;     ///< mean spacing of crests, square to them [m]
  Figure height;         ///< median, of a crest over the line between its troughs [m]
  Figure index;          ///< median of wavelength / height, section by section
  Figure orientation;    ///< of the crests, from -pi/2 to pi/2, counter-clockwise from east [rad]
  double concentration;  ///< mean resultant length of the doubled angles of the crests, 0 to 1
  Figure stoss_mean;     ///< medians of the slopes, positive [rad]: trough to crest ...
  Figure stoss_max;      ///< ... and steepest over a tenth of a wavelength
  Figure lee_mean;
  Figure lee_max;
  Figure asymmetry;       ///< median of stoss length / lee length
  Figure defect_density;  ///< ends of crests per area [m^-2]; the error is that of a count
  double defects_per_square_wavelength = 0;
  double crest_length = 0;  ///< mean of the crests [m]
  int crests = 0;
  int terminations = 0;
  int junctions = 0;
};

RippleField ripple_field(const RippleCrests& crests);

/// Where the wind that made the ripples of a map blew to, as far as their shape tells: square to the pattern
/// of the longest crests, with the steeper flanks downwind [rad]. Nothing for a map without ripples.
std::optional<double> likely_wind(const GridGeometry& geometry, const HeightMap::Layer& elevation);

}  // namespace aeolian
