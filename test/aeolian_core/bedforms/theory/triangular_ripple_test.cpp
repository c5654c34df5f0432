#include "aeolian_core/bedforms/theory/triangular_ripple.hpp"

#include <cmath>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

TEST(TriangularRippleTest, has_the_index_of_the_thesis) {
  const TriangularRipple shape(5 * degree, 10 * degree);
  EXPECT_NEAR(shape.index(), 17.1, 0.05);
  // Wavelength = L1 (1 + tan(stoss) / tan(impacts)).
  EXPECT_NEAR(shape.wavelength(0.01),
              shape.stoss_length(0.01) * (1 + std::tan(5 * degree) / std::tan(10 * degree)), 1e-15);
}

TEST(TriangularRippleTest, small_ones_are_faster_in_proportion_or_to_the_square) {
  const TriangularRipple shape(5 * degree, 10 * degree);
  const auto speed = [&](EjectionLaw ejection, double height) {
    return shape.speed(ejection, height, 1e5, 1e-3, 0.04);
  };
  EXPECT_NEAR(speed(EjectionLaw::target, 0.005) / speed(EjectionLaw::target, 0.01), 2, 1e-12);
  EXPECT_NEAR(speed(EjectionLaw::brink, 0.005) / speed(EjectionLaw::brink, 0.01), 4, 1e-12);
  // Eqs. 5.9 and 5.10 as printed.
  const double stoss = shape.stoss_length(0.01);
  EXPECT_NEAR(speed(EjectionLaw::target, 0.01), 1e5 * 1e-6 * 0.04 / (stoss * std::tan(5 * degree)), 1e-12);
  EXPECT_NEAR(speed(EjectionLaw::brink, 0.01),
              2 * 1e5 * 0.04 * 1e-9 * std::cos(5 * degree) / (stoss * stoss * std::tan(5 * degree)), 1e-12);
}

TEST(TriangularRippleTest, refuses_angles_without_a_triangle) {
  EXPECT_EQ(error_of([] { TriangularRipple(0, 10 * degree); }),
            "triangular ripple: stoss at 0.000000 degrees, must lie between 0 and 90");
  EXPECT_EQ(error_of([] { TriangularRipple(5 * degree, 90 * degree); }),
            "triangular ripple: impacts at 90.000000 degrees, must lie between 0 and 90");
  EXPECT_NE(error_of([] { TriangularRipple(NAN, 10 * degree); }), "no error was thrown");
}

}  // namespace
}  // namespace aeolian
