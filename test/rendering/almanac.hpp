#pragma once

namespace aeolian {

/// The sun over a place after the low-precision formulae of the Astronomical Almanac (page C5; 0.01 degrees
/// from 1950 to 2050), raised by the refraction of Saemundsson (1986). Written apart from the measuring code.
/// Angles in radians; azimuth clockwise from north; `unix_time` in s, UTC.
struct AlmanacSun {
  double elevation;
  double azimuth;
};
AlmanacSun almanac_sun(double unix_time, double latitude, double longitude);

}  // namespace aeolian
