#include "aeolian_core/grains/grain.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/grains/mean_splash.hpp"

namespace aeolian {
namespace {

std::string refusal(const Grain& grain) {
  return error_of([&] { check(grain); });
}

TEST(GrainTest, mass_is_that_of_a_sphere) {
  Grain grain;
  grain.diameter = 0.001;
  EXPECT_NEAR(grain.mass(), 2650 * 4.0 / 3 * M_PI * 0.5e-3 * 0.5e-3 * 0.5e-3, 1e-15);
}

TEST(GrainTest, effective_diameter_is_that_of_the_specification) {
  Grain grain;  // 0.956 d at a porosity of 0.40
  EXPECT_NEAR(grain.effective_diameter() / grain.diameter, 0.956, 0.001);
}

TEST(GrainTest, a_cube_of_effective_diameter_holds_the_solid_of_one_grain) {
  Grain grain;
  grain.porosity = 0.55;
  const double side = grain.effective_diameter();
  EXPECT_NEAR(side * side * side * (1 - grain.porosity) * grain.density, grain.mass(), 1e-12 * grain.mass());
}

TEST(GrainTest, ordinary_materials_are_allowed) {
  Grain snow;
  snow.diameter = 0.0002;
  snow.density = 910;
  EXPECT_NO_THROW(check(Grain{}));
  EXPECT_NO_THROW(check(snow));
}

TEST(GrainTest, refusals_name_the_property_and_what_is_allowed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -0.001, 1.0, nan}) {
    Grain grain;
    grain.diameter = bad;
    EXPECT_NE(refusal(grain).find("diameter"), std::string::npos) << bad;
  }
  Grain grain;
  grain.porosity = 1;
  EXPECT_EQ(refusal(grain), "grain: porosity is 1, must be 0.2 to 0.95");
  grain = Grain{};
  grain.density = nan;
  EXPECT_NE(refusal(grain).find("density"), std::string::npos);
  grain = Grain{};
  grain.angle_of_repose = 33;  // degrees given for radians
  EXPECT_NE(refusal(grain).find("angle of repose"), std::string::npos);
}

TEST(SplashTest, ejecta_are_proportional_to_speed) {
  const Grain grain;
  const MeanSplash splash;
  // Kok & Renno (2009): 0.02 v / sqrt(g d), 0.56 at 1.39 m/s and 0.25 mm.
  EXPECT_NEAR(splash.ejecta_per_impact(grain, 1.39), 0.561, 0.001);
  EXPECT_DOUBLE_EQ(splash.ejecta_per_impact(grain, 2.78), 2 * splash.ejecta_per_impact(grain, 1.39));
}

TEST(SplashTest, reptation_is_25_diameters) {
  EXPECT_DOUBLE_EQ(MeanSplash{}.reptation_length(Grain{}), 0.00625);
}

}  // namespace
}  // namespace aeolian
