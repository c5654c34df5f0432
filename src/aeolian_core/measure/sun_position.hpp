#pragma once

#include <string>

namespace aeolian {

/// Where the sun is seen from a place.
struct SunPosition {
  double elevation = 0;  ///< of its centre over the horizon, with refraction where it is up [rad]
  double azimuth = 0;    ///< of the sun, clockwise from true north [rad]
};

/// The sun's apparent place from the earth's centre, equator and equinox of date.
struct ApparentSun {
  double right_ascension = 0;        ///< from 0 to 2 pi [rad]
  double declination = 0;            ///< [rad]
  double distance = 0;               ///< [astronomical units]
  double equation_of_equinoxes = 0;  ///< apparent minus mean sidereal time [rad]
};

/// The sun at a Julian ephemeris day (terrestrial time): Meeus (1998), ch. 25, low accuracy (0.01 degrees).
ApparentSun apparent_sun(double julian_ephemeris_day);

/// The sun at a Unix time [s, UTC] from a place [rad, north and east positive], good to 0.01 degrees from
/// 1950 to 2050: Meeus (1998), "Astronomical Algorithms", ch. 25 (apparent place), 12 (sidereal time), 16
/// (refraction at 1010 hPa and 10 C), with the parallax.
SunPosition sun_position(double unix_time, double latitude, double longitude);

/// The Unix time [s] of "2026-06-01T15:30:00Z" (ISO 8601, UTC; fractions of a second allowed, the Z may be
/// absent). Throws Error naming the text.
double parse_utc(const std::string& text);

}  // namespace aeolian
