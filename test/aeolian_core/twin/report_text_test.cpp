#include "aeolian_core/twin/report_text.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(ReportText, ThreeSignificantDigits) {
  EXPECT_EQ(number_text(0.5432), "0.543");
  EXPECT_EQ(number_text(12.345), "12.3");
  EXPECT_EQ(number_text(1234.5), "1234");
  EXPECT_EQ(number_text(-0.0871), "−0.087");
  EXPECT_EQ(number_text(-0.00001), "0.000");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(NAN), "not available");
  EXPECT_EQ(number_text(-INFINITY), "−∞");
}

TEST(ReportText, UnitsSuitTheSize) {
  EXPECT_EQ(length_text(0.00123), "1.23 mm");
  EXPECT_EQ(length_text(-0.0123), "−12.3 mm");
  EXPECT_EQ(length_text(0.0876), "8.76 cm");
  EXPECT_EQ(length_text(12.5), "12.5 m");
  EXPECT_EQ(length_text(NAN), "not available");
  EXPECT_EQ(quantity_text(2.5e-5, volume_unit(2.5e-5)), "25.0 cm³");
  EXPECT_EQ(quantity_text(0.0025, volume_unit(0.0025)), "2.50 litres");
  EXPECT_EQ(time_unit(600).name, "min");
  EXPECT_EQ(time_unit(86400).name, "h");
}

TEST(ReportText, Durations) {
  EXPECT_EQ(duration_text(2.5), "2.50 s");
  EXPECT_EQ(duration_text(45), "45 s");
  EXPECT_EQ(duration_text(59.9), "1 min");
  EXPECT_EQ(duration_text(120), "2 min");
  EXPECT_EQ(duration_text(150), "2 min 30 s");
  EXPECT_EQ(duration_text(3600), "1 h");
  EXPECT_EQ(duration_text(3900), "1 h 5 min");
}

TEST(ReportText, SkillHasItsSign) {
  EXPECT_EQ(skill_text(0.4123), "+0.41");
  EXPECT_EQ(skill_text(-0.5), "−0.50");
  EXPECT_EQ(skill_text(0.001), "0.00");
  EXPECT_EQ(skill_text(-0.001), "0.00");
  EXPECT_EQ(skill_text(NAN), "not available");
}

}  // namespace
}  // namespace aeolian
