#include "aeolian_core/wind/direction.hpp"

#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(Direction, FourWinds) {
  EXPECT_DOUBLE_EQ(direction_from_meteorological(0), -M_PI / 2);   // a north wind blows to the south
  EXPECT_DOUBLE_EQ(direction_from_meteorological(90), M_PI);       // an east wind to the west
  EXPECT_DOUBLE_EQ(direction_from_meteorological(180), M_PI / 2);  // a south wind to the north
  EXPECT_DOUBLE_EQ(direction_from_meteorological(270), 0);         // a west wind to the east
  EXPECT_DOUBLE_EQ(direction_from_meteorological(225), M_PI / 4);
}

TEST(Direction, RoundTripOverTheCircleAndBeyond) {
  for (int degrees = -720; degrees <= 720; ++degrees) {
    const double direction = direction_from_meteorological(degrees);
    EXPECT_GT(direction, -M_PI) << degrees;
    EXPECT_LE(direction, M_PI) << degrees;
    const double back = meteorological_from_direction(direction);
    EXPECT_GE(back, 0) << degrees;
    EXPECT_LT(back, 360) << degrees;
    EXPECT_NEAR(std::remainder(back - degrees, 360.0), 0, 1e-10) << degrees;
  }
}

TEST(Direction, NorthIsZeroNotThreeHundredAndSixty) {
  for (const double slip : {-1e-17, 0.0, 1e-17, 1e-15, -1e-15}) {
    const double from = meteorological_from_direction(-M_PI / 2 + slip);
    EXPECT_GE(from, 0);
    EXPECT_LT(from, 360);
  }
}

TEST(Direction, WrapKeepsTheAngleAndPrefersPlusPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(M_PI), M_PI);
  EXPECT_DOUBLE_EQ(wrap_angle(-M_PI), M_PI);
  EXPECT_NEAR(wrap_angle(7 * M_PI / 2), -M_PI / 2, 1e-14);
  EXPECT_EQ(wrap_angle(0), 0);
  EXPECT_TRUE(std::isnan(wrap_angle(NAN)));
}

}  // namespace
}  // namespace aeolian
