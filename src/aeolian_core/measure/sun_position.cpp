#include "aeolian_core/measure/sun_position.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double seconds_per_day = 86400;
constexpr double unix_epoch = 2440587.5;  ///< Julian day
constexpr double j2000 = 2451545.0;
constexpr double days_per_century = 36525;

double turned_positive(double angle) {
  const double rest = std::fmod(angle, 2 * M_PI);
  return rest < 0 ? rest + 2 * M_PI : rest;
}

/// Terrestrial minus universal time [s]: Espenak & Meeus (2006), "Five Millennium Canon of Solar Eclipses".
/// A second of it moves the sun by 0.00001 degrees: years outside of 1941 to 2050 take the nearest one's.
double delta_t(double year) {
  year = std::clamp(year, 1941.0, 2050.0);
  if (year < 1961) {
    const double t = year - 1950;
    return 29.07 + 0.407 * t - t * t / 233 + t * t * t / 2547;
  }
  if (year < 1986) {
    const double t = year - 1975;
    return 45.45 + 1.067 * t - t * t / 260 - t * t * t / 718;
  }
  const double t = year - 2000;
  if (year < 2005)
    return 63.86 + t * (0.3345 + t * (-0.060374 + t * (0.0017275 + t * (0.000651814 + t * 0.00002373599))));
  return 62.92 + 0.32217 * t + 0.005589 * t * t;
}

/// Greenwich mean sidereal time (Meeus eq. 12.4) [rad].
double mean_sidereal_time(double julian_day) {
  const double t = (julian_day - j2000) / days_per_century;
  return degree *
         (280.46061837 + 360.98564736629 * (julian_day - j2000) + 0.000387933 * t * t - t * t * t / 38710000);
}

/// How much higher the sun is seen for the air, from its true elevation (Saemundsson; Meeus eq. 16.4) [rad].
double refraction(double elevation) {
  constexpr double upper_limb_rises = -0.8333 * degree;
  if (elevation < upper_limb_rises) return 0;
  const double h = elevation / degree;
  return degree / 60 * 1.02 / std::tan(degree * (h + 10.3 / (h + 5.11)));
}

/// Days from 1970-01-01 in the Gregorian calendar (Hinnant's days_from_civil).
std::int64_t days_since_epoch(int year, int month, int day) {
  const std::int64_t y = month <= 2 ? year - 1 : year;
  const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
  const std::int64_t year_of_era = y - era * 400;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return era * 146097 + day_of_era - 719468;
}

int days_in_month(int year, int month) {
  constexpr std::array<int, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return days[static_cast<std::size_t>(month - 1)] + (month == 2 && leap ? 1 : 0);
}

}  // namespace

ApparentSun apparent_sun(double julian_ephemeris_day) {
  const double t = (julian_ephemeris_day - j2000) / days_per_century;
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = degree * (357.52911 + t * (35999.05029 - t * 0.0001537));
  const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - t * 0.000101) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double true_anomaly = anomaly + degree * centre;
  const double node = degree * (125.04 - 1934.136 * t);
  const double nutation = -0.00478 * std::sin(node);
  const double aberration = -0.00569;
  const double longitude = degree * (mean_longitude + centre + aberration + nutation);
  const double mean_obliquity =
      23 + 26.0 / 60 + (21.448 - t * (46.8150 + t * (0.00059 - t * 0.001813))) / 3600;
  const double obliquity = degree * (mean_obliquity + 0.00256 * std::cos(node));

  ApparentSun sun;
  sun.right_ascension =
      turned_positive(std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)));
  sun.declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  sun.distance =
      1.000001018 * (1 - eccentricity * eccentricity) / (1 + eccentricity * std::cos(true_anomaly));
  sun.equation_of_equinoxes = degree * nutation * std::cos(obliquity);
  return sun;
}

SunPosition sun_position(double unix_time, double latitude, double longitude) {
  const double julian_day = unix_epoch + unix_time / seconds_per_day;
  const double year = 2000 + (julian_day - j2000) / 365.25;
  const ApparentSun sun = apparent_sun(julian_day + delta_t(year) / seconds_per_day);
  const double hour_angle =
      mean_sidereal_time(julian_day) + sun.equation_of_equinoxes + longitude - sun.right_ascension;

  SunPosition position;
  position.azimuth = turned_positive(
      M_PI + std::atan2(std::cos(sun.declination) * std::sin(hour_angle),
                        std::cos(sun.declination) * std::cos(hour_angle) * std::sin(latitude) -
                            std::sin(sun.declination) * std::cos(latitude)));
  const double true_elevation =
      std::asin(std::sin(latitude) * std::sin(sun.declination) +
                std::cos(latitude) * std::cos(sun.declination) * std::cos(hour_angle));
  const double parallax = degree * 8.794 / 3600 / sun.distance * std::cos(true_elevation);
  const double topocentric = true_elevation - parallax;
  position.elevation = topocentric + refraction(topocentric);
  return position;
}

double parse_utc(const std::string& text) {
  const auto fail = [&](const std::string& rule) {
    throw Error("time '" + text + "': " + rule + ", like 2026-06-01T15:30:00Z");
  };
  const std::string form = "0000-00-00T00:00:00";
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  bool fits = text.size() >= form.size();
  for (std::size_t i = 0; fits && i < form.size(); ++i)
    fits = form[i] == '0' ? is_digit(text[i]) : text[i] == form[i];
  std::string tail = fits ? text.substr(form.size()) : "";
  if (!tail.empty() && tail.back() == 'Z') tail.pop_back();
  double fraction = 0;
  if (!tail.empty()) {
    fits = tail.size() > 1 && tail[0] == '.' && std::all_of(tail.begin() + 1, tail.end(), is_digit);
    if (fits) std::from_chars(tail.data(), tail.data() + tail.size(), fraction);
  }
  if (!fits) fail("must be a time of UTC");

  const auto field = [&](std::size_t start, std::size_t count) {
    return std::stoi(text.substr(start, count));
  };
  const int year = field(0, 4);
  const int month = field(5, 2);
  const int day = field(8, 2);
  const int hour = field(11, 2);
  const int minute = field(14, 2);
  const int second = field(17, 2);
  if (month < 1 || month > 12 || day < 1 || day > days_in_month(year, month))
    fail("there is no such day, must be a time of UTC");
  if (hour > 23 || minute > 59 || second > 59) fail("there is no such hour, must be a time of UTC");
  return seconds_per_day * static_cast<double>(days_since_epoch(year, month, day)) + 3600.0 * hour +
         60.0 * minute + second + fraction;
}

}  // namespace aeolian
