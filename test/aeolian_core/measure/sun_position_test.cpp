#include "aeolian_core/measure/sun_position.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr double tolerance = 0.01;  // degrees, as promised

SunPosition sun_at(const std::string& utc, double latitude_deg, double longitude_deg) {
  return sun_position(parse_utc(utc), latitude_deg * degree, longitude_deg * degree);
}

double julian_day(const std::string& utc) { return 2440587.5 + parse_utc(utc) / 86400; }

TEST(SunPosition, ExampleOfMeeus25a) {  // 1992 October 13, 0 h TD
  const ApparentSun sun = apparent_sun(2448908.5);
  EXPECT_NEAR(sun.right_ascension / degree, 198.38083, 1e-5);
  EXPECT_NEAR(sun.declination / degree, -7.78507, 1e-5);
  EXPECT_NEAR(sun.distance, 0.99766, 1e-5);
}

TEST(SunPosition, ExampleOfMeeus25bWithTheFullTheory) {
  const ApparentSun sun = apparent_sun(2448908.5);
  EXPECT_NEAR(sun.right_ascension / degree, 198.378178, tolerance);
  EXPECT_NEAR(sun.declination / degree, -7.783871, tolerance);
  EXPECT_NEAR(sun.distance, 0.99760775, 1e-4);
}

// Reda & Andreas (2008), table A5.1. Their air has 820 hPa and 11 C: 0.004 degrees less refraction than ours.
TEST(SunPosition, ExampleOfTheNrelAlgorithm) {
  const SunPosition sun = sun_at("2003-10-17T19:30:30Z", 39.742476, -105.1786);
  EXPECT_NEAR(90 - sun.elevation / degree, 50.11162, tolerance);
  EXPECT_NEAR(sun.azimuth / degree, 194.34024, tolerance);
}

// Meeus, example 28.a: at that moment the equation of time is 3.427351 degrees, so that the sun culminates
// where mean solar time is that much before noon.
TEST(SunPosition, CulminatesAtTheEquationOfTime) {
  const double utc = parse_utc("1992-10-13T00:00:00Z") - 59;  // 0 h TD
  const double mean_sun = 180 + 59.0 / 240;                   // longitude of mean noon
  const SunPosition sun = sun_position(utc, 40 * degree, (mean_sun - 3.427351) * degree);
  EXPECT_NEAR(sun.azimuth / degree, 180, tolerance);
  const double refraction = 0.0137;  // Meeus eq. 16.4 at 42.2 degrees, less the parallax: 1.07' - 0.11'
  EXPECT_NEAR(sun.elevation / degree, 50 - 7.783871 + refraction + 0.0021, tolerance);
}

TEST(SunPosition, SolsticesAndEquinoxesOfTheAlmanacs) {
  // Meeus, example 27.a: June solstice 1962, 21 h 24 m 42 s TD; the obliquity was 23.4444 (mean, eq. 22.2).
  EXPECT_NEAR(apparent_sun(julian_day("1962-06-21T21:24:42Z")).declination / degree, 23.4442, tolerance);
  EXPECT_NEAR(apparent_sun(julian_day("1962-06-21T21:24:42Z")).right_ascension / degree, 90, tolerance);
  // Equinox and solstices of 2024 (USNO), to the minute; the sun climbs 0.0165 degrees an hour at most.
  EXPECT_NEAR(apparent_sun(julian_day("2024-03-20T03:06:00Z")).declination / degree, 0, tolerance);
  EXPECT_NEAR(apparent_sun(julian_day("2024-09-22T12:44:00Z")).declination / degree, 0, tolerance);
  EXPECT_NEAR(apparent_sun(julian_day("2024-06-20T20:51:00Z")).declination / degree, 23.4386, tolerance);
  EXPECT_NEAR(apparent_sun(julian_day("2024-12-21T09:21:00Z")).declination / degree, -23.4386, tolerance);
}

TEST(SunPosition, RisesDueEastAtTheEquatorOnAnEquinox) {
  // The meridian where it is half past seven by the sun; then where it is half past four in the afternoon.
  for (const double longitude : {66.0, 80.0}) {
    const SunPosition sun = sun_at("2024-03-20T03:06:00Z", 0, longitude);
    EXPECT_GT(sun.elevation, 0);
    EXPECT_NEAR(sun.azimuth / degree, 90, 0.02);
  }
  EXPECT_NEAR(sun_at("2024-03-20T03:06:00Z", 0, -150).azimuth / degree, 270, 0.02);
}

TEST(SunPosition, IsLiftedByTheAirOnTheHorizon) {
  // Almanacs reckon with 34' of refraction for a sun that is seen on the horizon.
  const double utc = parse_utc("2024-03-20T06:00:00Z");
  double night = -20 * degree;
  double day = 20 * degree;
  for (int i = 0; i < 60; ++i) {
    const double middle = (night + day) / 2;
    (sun_position(utc, 0, middle).elevation > 0 ? day : night) = middle;
  }
  const double equation_of_time = -7.44 / 4;  // minutes to degrees
  const double hour_angle = day / degree - 90 + equation_of_time;
  EXPECT_NEAR(-90 - hour_angle, 34.0 / 60, 0.02);
}

TEST(ParseUtc, ReadsIsoTimes) {
  EXPECT_EQ(parse_utc("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(parse_utc("2000-02-29T12:00:00"), 951825600);
  EXPECT_EQ(parse_utc("2026-06-01T15:30:00Z"), 1780327800);
  EXPECT_EQ(parse_utc("2026-06-01T15:30:00.25Z"), 1780327800.25);
  EXPECT_EQ(parse_utc("1969-12-31T23:59:59Z"), -1);
}

TEST(ParseUtc, RefusesWhatIsNone) {
  for (const std::string text :
       {"", "2026-06-01", "2026-06-01 15:30:00", "2026-6-1T15:30:00Z", "2026-06-01T15:30Z",
        "2026-06-01T15:30:00+02:00", "2026-06-01T15:30:00.Z", "2026-06-01T15:30:00ZZ",
        "2026-06-01T15:30:00.5e3", "-026-06-01T15:30:00", "noon"})
    EXPECT_EQ(error_of([&] { parse_utc(text); }),
              "time '" + text + "': must be a time of UTC, like 2026-06-01T15:30:00Z");
  for (const std::string text : {"2026-13-01T00:00:00Z", "2026-02-29T00:00:00Z", "2026-00-10T00:00:00Z",
                                 "2026-04-31T00:00:00Z", "2100-02-29T00:00:00Z", "2026-01-00T00:00:00Z"})
    EXPECT_EQ(error_of([&] { parse_utc(text); }),
              "time '" + text + "': there is no such day, must be a time of UTC, like 2026-06-01T15:30:00Z");
  for (const std::string text : {"2026-01-01T24:00:00Z", "2026-01-01T00:60:00Z", "2026-01-01T00:00:60Z"})
    EXPECT_EQ(error_of([&] { parse_utc(text); }),
              "time '" + text + "': there is no such hour, must be a time of UTC, like 2026-06-01T15:30:00Z");
}

}  // namespace
}  // namespace aeolian
