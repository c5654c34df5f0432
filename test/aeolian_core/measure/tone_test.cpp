#include "aeolian_core/measure/tone.hpp"

#include <gtest/gtest.h>

namespace aeolian {
namespace {

// IEC 61966-2-1: the values of the standard's curve.
TEST(Tone, UndoesTheSrgbCurve) {
  Photo photo;
  photo.width_px = 5;
  photo.height_px = 1;
  photo.values8 = {0, 10, 128, 188, 255};
  const Tone tone(photo);
  EXPECT_NEAR(tone(0, 0), 0, 1e-7);
  EXPECT_NEAR(tone(1, 0), 10 / 255.0 / 12.92, 1e-6);
  EXPECT_NEAR(tone(2, 0), 0.2158605, 1e-6);
  EXPECT_NEAR(tone(3, 0), 0.5028865, 1e-6);
  EXPECT_NEAR(tone(4, 0), 1, 1e-6);
  EXPECT_EQ(tone(9, -3), tone(4, 0));
  EXPECT_NEAR(tone(2.25, 0.0), 0.75 * 0.2158605 + 0.25 * 0.5028865, 1e-5);
}

TEST(Tone, SixteenBitsAreTheSameCurve) {
  Photo photo;
  photo.width_px = 2;
  photo.height_px = 1;
  photo.white = 65535;
  photo.values16 = {static_cast<std::uint16_t>(128 * 257), 65535};
  const Tone tone(photo);
  EXPECT_NEAR(tone(0, 0), 0.2158605, 1e-6);
  EXPECT_NEAR(tone(1, 0), 1, 1e-6);
}

}  // namespace
}  // namespace aeolian
