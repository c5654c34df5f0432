#include "aeolian_core/saltation/saltation_source.hpp"

#include <limits>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const SaltationTable& table() {
  static const SaltationTable shipped =
      SaltationTable::read(AEOLIAN_REPOSITORY "/config/saltation/quartz_in_air.csv");
  return shipped;
}

Grain sand(double diameter, double density = 2650) {
  Grain grain;
  grain.diameter = diameter;
  grain.density = density;
  return grain;
}

TEST(SaltationSourceTest, by_default_it_is_the_law) {
  const SaltationSource source;
  for (const double air : {0.5, 1.225, 60.0}) {
    const SaltationState a = source.state(0.5, sand(0.002, 900), air);
    const SaltationState b = steady_saltation(0.5, sand(0.002, 900), air);
    EXPECT_EQ(a.mass_flux, b.mass_flux);
    EXPECT_EQ(a.impact_threshold, b.impact_threshold);
  }
}

TEST(SaltationSourceTest, a_table_gives_its_states) {
  const SaltationSource source(table());
  for (const double u : {0.1, 0.25, 0.6}) {
    const SaltationState a = source.state(u, sand(0.0003));
    const SaltationState b = table().state(u, 0.0003);
    EXPECT_EQ(a.friction_velocity, u);
    EXPECT_DOUBLE_EQ(a.mass_flux, b.mass_flux);
    EXPECT_DOUBLE_EQ(a.impact_rate, b.impact_rate);
    EXPECT_DOUBLE_EQ(a.impact_threshold, b.impact_threshold);
    EXPECT_EQ(a.impact_angle_spread, b.impact_angle_spread);
  }
}

/// Thin air, thick air, heavy grains: solved anew, with the air's viscosity as it then is.
TEST(SaltationSourceTest, other_densities_agree_with_solved_states) {
  const SaltationSource source(table());
  const struct {
    double air, density, diameter;
  } cases[] = {{1.0, 2650, 0.00025}, {1.4, 2650, 0.0005}, {1.18, 2900, 0.00015}};
  for (const auto& c : cases) {
    SaltatingBed bed;
    bed.grain = sand(c.diameter, c.density);
    bed.atmosphere.viscosity *= bed.atmosphere.density / c.air;
    bed.atmosphere.density = c.air;
    const SaltationSolver solver(bed, KokRennoKernel(bed.grain, bed.atmosphere));
    const double threshold = *solver.impact_threshold();
    for (const double ratio : {1.2, 2.0}) {
      const SteadyState solved = solver.solve(ratio * threshold);
      const SaltationState state = source.state(ratio * threshold, bed.grain, c.air);
      const double allowed = ratio < 1.5 ? 0.08 : 0.02;
      EXPECT_NEAR(state.mass_flux / solved.mass_flux(), 1, allowed) << c.air << " " << ratio;
      EXPECT_NEAR(state.impact_rate / solved.impact_rate(), 1, allowed + 0.02) << c.air << " " << ratio;
      EXPECT_NEAR(state.surface_friction_velocity / solved.surface_friction_velocity, 1, 0.02) << c.air;
      EXPECT_NEAR(state.impact_threshold / threshold, 1, 0.02) << c.air;
    }
  }
}

TEST(SaltationSourceTest, what_a_table_does_not_hold_is_refused) {
  const SaltationSource source(table());
  EXPECT_EQ(error_of([&] { source.check(sand(0.002)); }),
            "saltation table: the grain's diameter is 0.002, must be 0.0001 to 0.001 m");
  EXPECT_EQ(error_of([&] { source.check(sand(0.0003, 910)); }),
            "saltation table: density of the grain over that of the air is 742.857, must be 1622.45 to "
            "2704.08");
  EXPECT_THROW(source.state(0.4, sand(0.0003), 0.02), Error);
  EXPECT_THROW(source.state(0.4, sand(0.0003), std::numeric_limits<double>::quiet_NaN()), Error);
  EXPECT_THROW(source.state(-1, sand(0.0003)), Error);
  EXPECT_THROW(source.check(sand(-1)), Error);
}

}  // namespace
}  // namespace aeolian
