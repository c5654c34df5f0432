#include "aeolian_core/bedforms/height_map/wavelength_law.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

Forcing blown(double friction_velocity, double diameter) {
  Forcing forcing;
  forcing.friction_velocity = friction_velocity;
  forcing.grain.diameter = diameter;
  return forcing;
}

TEST(WavelengthLawTest, constant_law_counts_grains) {
  const ConstantWavelength law(250);
  EXPECT_DOUBLE_EQ(law.final_wavelength(blown(0.3, 0.0004)), 0.1);
  EXPECT_DOUBLE_EQ(law.final_wavelength(blown(0.6, 0.0004)), 0.1);
}

TEST(WavelengthLawTest, linear_law_rises_from_zero_at_the_impact_threshold) {
  const LinearWavelength law(250);
  Grain grain;
  grain.diameter = 0.00025;
  const double threshold = steady_saltation(0, grain).impact_threshold;
  const auto at = [&](double ratio) { return law.final_wavelength(blown(ratio * threshold, 0.00025)); };
  EXPECT_NEAR(at(1), 0, 1e-12);
  EXPECT_NEAR(at(2), 250 * 0.00025, 1e-12);
  EXPECT_NEAR(at(3), 500 * 0.00025, 1e-12);
}

TEST(WavelengthLawTest, final_wavelengths_are_no_shorter_than_the_first_ones_measured) {
  // Initial wavelengths at 0.12 mm (specification sec. 7, secondary source), within half of them.
  const LinearWavelength law(250);
  for (const auto& [wind, initial] : {std::pair{0.35, 0.015}, {0.51, 0.045}, {0.65, 0.085}})
    EXPECT_GT(law.final_wavelength(blown(wind, 0.00012)), 0.75 * initial) << wind;
}

TEST(WavelengthLawTest, laws_have_names) {
  EXPECT_EQ(make_wavelength_law("none", 250), nullptr);
  EXPECT_DOUBLE_EQ(make_wavelength_law("constant", 200)->final_wavelength(blown(0.5, 0.001)), 0.2);
  EXPECT_GT(make_wavelength_law("linear", 200)->final_wavelength(blown(0.5, 0.0002)), 0);
  EXPECT_THROW(make_wavelength_law("quadratic", 250), Error);
}

TEST(WavelengthLawTest, refuses_what_is_no_wavelength) {
  for (const double diameters : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(ConstantWavelength{diameters}, Error);
    EXPECT_THROW(LinearWavelength{diameters}, Error);
  }
  EXPECT_THROW(LinearWavelength(250).final_wavelength(blown(0, 0.0004)), Error);
}

}  // namespace
}  // namespace aeolian
