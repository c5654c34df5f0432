#pragma once

namespace aeolian {

/// The noise of a range sensor, and between which ranges it holds.
///
/// Along the ray a reading at range R [m] under incidence angle b (between ray and vertical, the normal of a
/// bed of small slopes) has the standard deviation
///
///     s(R, b) = (range_sigma + range_sigma_per_metre R + range_sigma_per_square_metre R^2)
///               (1 + incidence_growth (1 / cos b - 1)),
///
/// across the ray R angular_sigma. A range error d misses a bed of slope m along the ray by
/// d (cos b - m sin b), a sideways error e by e (sin b + m cos b); with an rms slope m = 0.1 (ripples of
/// index 15 have about this) the variance of a height is
///
///     s^2 (cos^2 b + m^2 sin^2 b) + (R angular_sigma)^2 (sin^2 b + m^2 cos^2 b).
///
/// Time-of-flight noise grows as 1 / cos b with the spread of the echo: Soudarissanane et al. (2011), ISPRS
/// J. Photogramm. Remote Sens. 66, 389-399. Coefficients of devices: config/sensors/.
struct SensorNoise {
  double range_sigma = 0.001;               ///< [m]
  double range_sigma_per_metre = 0;         ///< may be negative where the sum stays positive [m/m]
  double range_sigma_per_square_metre = 0;  ///< likewise [m/m^2]
  double angular_sigma = 0;                 ///< of the ray's direction [rad]
  double incidence_growth = 0;              ///< 0: none, 1: as 1 / cos b
  double range_bias = 0;                    ///< measured minus true range, taken off every reading [m]
  double min_range = 0;                     ///< nearer readings do not count [m]
  double max_range = 1e4;                   ///< farther readings do not count [m]

  static constexpr double bed_slope = 0.1;
  /// Rays flatter than this are taken to be this flat: the models end before.
  static constexpr double least_cosine = 0.05;

  double along_ray(double range, double cosine) const;
  /// Of the height of one point [m^2]; `cosine` is cos b.
  double height_variance(double range, double cosine) const;
  /// Throws Error naming a member that is not finite or that makes the noise negative within the ranges.
  void require_valid() const;
};

}  // namespace aeolian
