#include "aeolian_core/bedforms/height_map/ripple_growth.hpp"

#include <cmath>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/height_map/impact_angles.hpp"

namespace aeolian {

FastestGrowth fastest_growth(const Forcing& forcing, double hop_shortening, double slope_effect) {
  const ImpactAngles angles(forcing.impact_angle, forcing.impact_angle_spread);
  const double contrast = 1 / angles.effective_tangent() - hop_shortening;
  const double hop = forcing.reptation_length;
  if (!(contrast > slope_effect) || !(hop > 0)) return {};
  const double root = std::sqrt(contrast) - std::sqrt(slope_effect);
  // (k a)^2 of the fastest wave.
  const double square = std::sqrt(contrast / slope_effect) - 1;
  return {2 * M_PI * hop / std::sqrt(square), forcing.erosion_rate() / hop * root * root,
          forcing.erosion_rate() * contrast / (1 + 1 / square)};
}

}  // namespace aeolian
