#include "aeolian_core/bedforms/theory/merger_theory.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr double cm = 0.01;
const TriangularRipple shape(5 * degree, 10 * degree);

TEST(MergerTheoryTest, limiting_wavelengths_are_those_of_figure_5_24) {
  // Specification sec. 4: ratio; by overshoot and by shearing: wavelength of the smaller, of the merged [cm].
  struct Case {
    double ratio, overshoot, overshoot_merged, shearing, shearing_merged;
  };
  const double overshoot = overshoot_height(4 * cm, 10 * degree);
  EXPECT_NEAR(overshoot, 0.705 * cm, 0.001 * cm);
  const double shearing = shearing_height(0.1 * cm);
  EXPECT_NEAR(shearing, 0.23 * cm, 1e-12);
  for (const Case& c :
       {Case{0.9, 12.6, 18.9, 4.1, 6.2}, Case{0.8, 13.4, 21.4, 4.4, 7.0}, Case{0.7, 14.4, 25.1, 4.7, 8.2},
        Case{0.6, 15.9, 30.8, 5.2, 10.1}, Case{0.5, 18.0, 40.2, 5.9, 13.1}}) {
    const LimitingWavelength by_overshoot = limiting_wavelength(shape, c.ratio, overshoot);
    const LimitingWavelength by_shearing = limiting_wavelength(shape, c.ratio, shearing);
    EXPECT_NEAR(by_overshoot.smaller / (c.overshoot * cm), 1, 0.01) << c.ratio;
    EXPECT_NEAR(by_overshoot.merged() / (c.overshoot_merged * cm), 1, 0.01) << c.ratio;
    EXPECT_NEAR(by_shearing.smaller / (c.shearing * cm), 1, 0.01) << c.ratio;
    EXPECT_NEAR(by_shearing.merged() / (c.shearing_merged * cm), 1, 0.01) << c.ratio;
  }
  // The field's 20 cm.
  EXPECT_LT(limiting_wavelength(shape, 0.9, overshoot).merged(), 20 * cm);
  EXPECT_GT(limiting_wavelength(shape, 0.8, overshoot).merged(), 20 * cm);
}

TEST(MergerTheoryTest, longer_hops_and_flatter_impacts_let_ripples_grow_longer) {
  const auto merged = [](double hop, double angle) {
    return limiting_wavelength(TriangularRipple(5 * degree, angle), 0.8, overshoot_height(hop, angle))
        .merged();
  };
  EXPECT_NEAR(merged(8 * cm, 10 * degree) / merged(4 * cm, 10 * degree), 2, 1e-12);
  // A stronger wind widens hops and flattens impacts at once.
  EXPECT_GT(merged(5 * cm, 9 * degree), merged(4 * cm, 10 * degree));
}

TEST(MergerTheoryTest, fluctuations_of_a_ripple_are_those_of_the_thesis) {
  // d 0.1 cm, index 20, strip of 1 cm, 5 impacts per cm^2 and s that move 20 cm each: wavelengths of 200, 100
  // and 40 d fluctuate by 1, 2.8 and 11.2 %.
  const auto budget = [](double diameters) {
    return fluctuation_budget({diameters * 0.1 * cm, 20, cm, 0.1 * cm}, 5 / (cm * cm), 20 * cm);
  };
  EXPECT_NEAR(budget(200).speed, 0.1 * cm, 1e-9);
  EXPECT_NEAR(budget(200).period, 200, 1e-6);
  EXPECT_NEAR(budget(200).impacts, 10000, 1e-4);
  EXPECT_NEAR(budget(200).relative, 0.010, 1e-6);
  EXPECT_NEAR(budget(100).relative, 0.028, 5e-4);
  EXPECT_NEAR(budget(40).relative, 0.112, 5e-4);
}

}  // namespace
}  // namespace aeolian
