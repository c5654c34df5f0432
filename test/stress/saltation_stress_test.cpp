// The saltation solver over sizes, materials, airs and winds that nobody would choose: ./twin stress
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "aeolian_core/saltation/saltation.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

TEST(SaltationStress, a_state_is_in_balance_or_says_why_there_is_none) {
  RandomStream random(1, 0);
  const auto log_between = [&](double low, double high) {
    return low * std::pow(high / low, random.uniform());
  };
  int steady = 0;
  for (int n = 0; n < 150; ++n) {
    SaltatingBed bed;
    bed.grain.diameter = log_between(5e-5, 5e-3);
    bed.grain.density = log_between(300, 8000);
    bed.atmosphere.density = log_between(0.015, 70);
    bed.drag_law = n % 2 == 0 ? DragLaw::sand : DragLaw::sphere;
    const double friction_velocity = bed.fluid_threshold() * log_between(0.3, 8);
    if (friction_velocity > 10) continue;
    SCOPED_TRACE(fmt::format("{}: d {:g} m of {:g} kg/m3 in air of {:g} kg/m3, u* {:g} m/s", n,
                             bed.grain.diameter, bed.grain.density, bed.atmosphere.density,
                             friction_velocity));
    const KokRennoKernel splash(bed.grain, bed.atmosphere);
    const SteadyState state = SaltationSolver(bed, splash).solve(friction_velocity);
    if (!state.steady()) {
      EXPECT_FALSE(state.reason.empty());
      continue;
    }
    ++steady;
    EXPECT_NEAR(state.replacement, 1, 2e-3);
    EXPECT_TRUE(std::isfinite(state.mass_flux()));
    EXPECT_GT(state.mass_flux(), 0);
    EXPECT_GT(state.surface_friction_velocity, 0);
    EXPECT_LE(state.surface_friction_velocity, friction_velocity * (1 + 1e-6));
  }
  EXPECT_GT(steady, 60);
}

}  // namespace
}  // namespace aeolian
