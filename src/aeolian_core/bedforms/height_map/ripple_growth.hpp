#pragma once

namespace aeolian {

struct Forcing;

/// The wave that grows fastest on a flat bed, by linear theory (specification sec. 5.4).
struct FastestGrowth {
  double wavelength = 0;  ///< 2 pi a / sqrt(sqrt(C / mu) - 1), C = mean cotangent of impact angles - nu [m]
  double rate = 0;        ///< (K0 / a) (sqrt(C) - sqrt(mu))^2 [1/s]; zero where no wave grows
  double speed = 0;       ///< (K0 C k^2 a^2) / (1 + k^2 a^2) [m/s]
};

/// `hop_shortening` nu and `slope_effect` mu as in RippleParameters.
FastestGrowth fastest_growth(const Forcing& forcing, double hop_shortening, double slope_effect);

}  // namespace aeolian
