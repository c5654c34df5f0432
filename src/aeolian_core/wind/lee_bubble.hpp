#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/wind/wind_relief.hpp"

namespace aeolian {

/// Where the flow separates behind a steep lee (Kroy, Sauermann & Herrmann 2002).
struct LeeBubble {
  double onset = 0.306;     ///< slope at which a lee is too steep for the flow to follow (17 degrees)
  double steepest = 0.213;  ///< downslope of the streamline that bounds the separated air (12 degrees)
};

/// A profile along the wind, equally spaced, with the air separated behind each lee steeper than the onset
/// filled up: from the brink, with its slope, a cubic comes down to the ground, level, after
/// (3 H/2 c)(1 + a/4 + a^2/8), a = brink slope/c, c = steepest. `height` is raised to it. True where it was.
/// A bubble that does not end before the profile does is cut off there.
std::vector<std::uint8_t> fill_bubbles(std::vector<double>& height, double spacing, const LeeBubble& bubble);

/// A relief with its bubbles for one wind.
struct ShelteredRelief {
  WindRelief relief;                    ///< raised to the tops of the bubbles
  std::vector<std::uint8_t> separated;  ///< of each cell; empty when the flow separates nowhere
};
/// `direction` that the wind blows to [rad]; the profiles are rows along it.
ShelteredRelief sheltered(WindRelief relief, double direction, const LeeBubble& bubble);

}  // namespace aeolian
