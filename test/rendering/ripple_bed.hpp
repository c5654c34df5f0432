#pragma once

#include <cmath>

namespace aeolian {

/// Regular ripples on a tilted plane, stoss slopes gentler than lee slopes.
struct RippleBed {
  double height = 0;   ///< of the plane at the origin, level frame [m]
  double slope_x = 0;  ///< of the plane
  double slope_y = 0;
  double wavelength = 0.08;  ///< square to the crests [m]
  double relief = 0.005;     ///< crest over trough [m]
  double skew = 0.5;         ///< share by which the lee is steeper, and the stoss gentler, than a sine
  double crest_angle = 0;    ///< of the crests from the y axis, towards x [rad]
  double phase = 0;          ///< of the wave at the origin [rad]
  int downwind = 1;          ///< +1: the lee looks to larger x

  double phase_at(double x, double y) const {
    return phase + 2 * M_PI / wavelength * (x * std::cos(crest_angle) - y * std::sin(crest_angle));
  }
  double operator()(double x, double y) const {
    const double p = downwind * phase_at(x, y);
    return height + slope_x * x + slope_y * y + relief / 2 * std::cos(p - skew * std::cos(p));
  }
};

}  // namespace aeolian
