#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/measure/ripple_pattern.hpp"

namespace aeolian {

/// The ripples of a map without the bed that they lie on and without noise, resampled to rows square to the
/// crests, a sample per cell.
///
/// The surface smoothed over a wavelength is taken off (specification sec. 9.25). Noise is smoothed with a
/// Gaussian of a fifth of a wavelength along the crests, and across them with a kernel of fourth order (which
/// leaves parabolas as they are) of a fortieth to a fourteenth, as noise asks for: sinusoids lose less than
/// 0.5 % of their height.
struct RippleRelief {
  RipplePattern pattern;
  double cell = 0;         ///< between samples and between rows [m]
  Eigen::Vector2d origin;  ///< of row 0, sample 0 [m]
  Eigen::Vector2d along;   ///< unit vector of a row, downwind
  Eigen::Vector2d left;    ///< unit vector from row to row
  int rows = 0;
  int length = 0;                ///< samples in a row
  std::vector<float> height;     ///< row by row [m]
  std::vector<float> clearance;  ///< distance from what is not seen [m]; 0 where it is not
  double noise = 0;              ///< of the heights, standard deviation [m]

  std::size_t index(int row, int sample) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(length) +
           static_cast<std::size_t>(sample);
  }
  /// Of a place in samples [m].
  Eigen::Vector2d point(double row, double sample) const {
    return origin + cell * (sample * along + row * left);
  }
  /// How far a point [m] is from the nearest that is not seen [m].
  double clearance_at(const Eigen::Vector2d& point) const;
};

/// The relief of a map, its crests about square to `direction` [rad]. Nothing when it has no ripples that can
/// be told from noise. Throws Error when heights and cells differ in number or the direction is not finite.
std::optional<RippleRelief> ripple_relief(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                                          double direction);

}  // namespace aeolian
