#include "almanac.hpp"

#include <cmath>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {

AlmanacSun almanac_sun(double unix_time, double latitude, double longitude) {
  const double days = unix_time / 86400 - 10957.5;  // since J2000.0; dynamical time is near enough
  const double mean_longitude = (280.460 + 0.9856474 * days) * degree;
  const double anomaly = (357.528 + 0.9856003 * days) * degree;
  const double ecliptic =
      mean_longitude + (1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * degree;
  const double obliquity = (23.439 - 0.0000004 * days) * degree;
  const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(ecliptic), std::cos(ecliptic));
  const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic));
  const double sidereal = (280.46062 + 360.98564737 * days) * degree;
  const double hour = sidereal + longitude - right_ascension;
  const double sine = std::sin(latitude) * std::sin(declination) +
                      std::cos(latitude) * std::cos(declination) * std::cos(hour);
  const double azimuth = std::atan2(-std::cos(declination) * std::sin(hour),
                                    std::sin(declination) * std::cos(latitude) -
                                        std::cos(declination) * std::sin(latitude) * std::cos(hour));
  const double height = std::asin(sine) / degree;
  const double parallax = 0.0024 * std::cos(height * degree);
  const double refraction = 1.02 / 60 / std::tan((height + 10.3 / (height + 5.11)) * degree);
  return {(height - parallax + refraction) * degree, azimuth};
}

}  // namespace aeolian
