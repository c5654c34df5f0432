#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/atmosphere.hpp"

namespace aeolian {

/// Friction velocity above which the wind lifts grains that stick together, by Shao & Lu (2000): sqrt(0.0123
/// ((rho_s / rho) g d + gamma / (rho d))) [m/s]. `gamma` [kg/s^2]: 3e-4 for sand, several times that for
/// snow.
double lifting_threshold(const Grain& grain, const Atmosphere& air, double gamma);

/// Flux of saturated saltation [kg m^-1 s^-1] for a threshold u*_t; zero up to it (specification, sec. 6).
/// @{
/// 5 (rho / g) u*_it (u*^2 - u*_it^2), u*_it = 0.8 u*_t.
double saturated_sand_flux(double friction_velocity, double threshold, const Atmosphere& air);
/// 0.68 rho u*_t (u*^2 - u*_t^2) / (g u*) (Pomeroy & Gray 1990).
double saturated_snow_flux(double friction_velocity, double threshold, const Atmosphere& air);
/// @}

}  // namespace aeolian
