#pragma once

#include <memory>

#include "aeolian_core/grains/splash/splash.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// Ground that gives no grains of its own: a road, ice, a crust. Grains rebound with the angle-dependent
/// restitution of Werner's experiment (CoarseSandRebound) and throw up nothing.
std::shared_ptr<const Splash> hard_ground_splash(const Grain& grain);

/// Saltation whose flux [kg m^-1 s^-1] comes from upwind: on hard ground exactly one grain leaves for each
/// that lands, so numbers do not adjust themselves, and the layer grows until drag and rebound balance
/// (Werner 1987, sec. 4.4). The wind is in balance with the grains; what stays behind is replaced by the
/// supply. Outcome `none` where the wind cannot carry so many. Throws Error for a friction velocity or a flux
/// that is not positive and finite.
SteadyState supplied_state(const SaltatingBed& bed, const SplashKernel& splash, double friction_velocity,
                           double mass_flux, const SolverSettings& settings = {});

}  // namespace aeolian
