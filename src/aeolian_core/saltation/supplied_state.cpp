#include "aeolian_core/saltation/supplied_state.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/saltation/approach.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double part = 0.3;   ///< of a new wind at the surface that is taken in one step
constexpr double calm = 0.01;  ///< surface over free wind below which the wind is used up

class NoEjection : public Ejection {
 public:
  double mean_number(const Impact&) const override { return 0; }
  void sample(const Impact&, RandomStream&, std::vector<LeavingGrain>&) const override {}
};

}  // namespace

std::shared_ptr<const Splash> hard_ground_splash(const Grain& grain) {
  return std::make_shared<ComposedSplash>(std::make_shared<CoarseSandRebound>(grain),
                                          std::make_shared<NoEjection>());
}

SteadyState supplied_state(const SaltatingBed& bed, const SplashKernel& splash, double free, double mass_flux,
                           const SolverSettings& settings) {
  check(bed);
  if (!(free > 0 && free <= 10))
    throw Error("saltation: friction velocity is " + std::to_string(free) + " m/s, must be above 0 to 10");
  if (!(mass_flux > 0 && std::isfinite(mass_flux)))
    throw Error("saltation: the supplied flux is " + std::to_string(mass_flux) +
                " kg/(m s), must be positive");
  const FlyingGrains grains(Drag(bed.drag_law, bed.grain, bed.atmosphere, bed.drag_scale));
  Approach approach(bed, splash, grains, settings.flight_tolerance);
  double surface = 0.99 * free;
  approach.set_winds(free, surface);
  for (int n = 0; n < 20 * settings.most_iterations; ++n) {
    approach.step();
    if (!approach.extend_if_cut_off()) break;
    const double left = free * free - mass_flux / approach.flux_over_stress() / bed.atmosphere.density;
    const double asked = std::sqrt(std::max(left, calm * calm * free * free));
    if (approach.same_spectrum(settings.tolerance) && std::abs(asked / surface - 1) < settings.tolerance) {
      SteadyState state = approach.state();
      state.outcome =
          left > calm * calm * free * free ? SteadyState::Outcome::steady : SteadyState::Outcome::none;
      if (!state.steady()) state.reason = "the wind cannot carry as many grains as come";
      return state;
    }
    surface += part * (asked - surface);
    approach.accept();
    approach.set_winds(free, surface);
  }
  SteadyState state = approach.state();
  state.outcome = SteadyState::Outcome::none;
  state.reason = "numbers of grains and wind do not settle";
  return state;
}

}  // namespace aeolian
