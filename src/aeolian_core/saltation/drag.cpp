#include "aeolian_core/saltation/drag.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"atmosphere"};

/// c_d Re, which stays finite in still air.
double coefficient_times_reynolds(DragLaw law, double reynolds) {
  if (law == DragLaw::sphere) return 24 + 6 * reynolds / (1 + std::sqrt(reynolds)) + 0.4 * reynolds;
  const double root = std::cbrt(32.0 * 32.0) + std::cbrt(reynolds * reynolds);
  return root * std::sqrt(root);
}

double drag_rate(DragLaw law, const Grain& grain, const Atmosphere& air, double speed) {
  const double reynolds = grain.diameter * speed / air.viscosity;
  return 0.75 * (air.density / grain.density) * air.viscosity / (grain.diameter * grain.diameter) *
         coefficient_times_reynolds(law, reynolds);
}

}  // namespace

void check(const Atmosphere& air) {
  require(air.density >= 1e-3 && air.density <= 200, "density", air.density, "0.001 to 200 kg/m^3");
  require(air.viscosity >= 1e-8 && air.viscosity <= 0.1, "viscosity", air.viscosity, "1e-8 to 0.1 m^2/s");
  require(air.gravity >= 0.1 && air.gravity <= 100, "gravity", air.gravity, "0.1 to 100 m/s^2");
}

double drag_coefficient(DragLaw law, double reynolds) {
  return coefficient_times_reynolds(law, reynolds) / reynolds;
}

double terminal_speed(DragLaw law, const Grain& grain, const Atmosphere& air) {
  check(grain);
  check(air);
  double low = 0;
  double high = 1;
  const auto too_slow = [&](double speed) { return speed * drag_rate(law, grain, air, speed) < air.gravity; };
  while (too_slow(high)) high *= 2;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (too_slow(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Drag::Drag(DragLaw law, const Grain& grain, const Atmosphere& atmosphere, double scale) : table_(-30, 46) {
  check(grain);
  check(atmosphere);
  if (!(scale > 0 && scale <= 10))
    throw Error("drag: scale is " + std::to_string(scale) + ", must be above 0 to 10");
  const auto rate_at = [&](std::size_t knot) {
    return scale * drag_rate(law, grain, atmosphere, std::sqrt(table_.knot(knot)));
  };
  for (std::size_t i = 0; i < table_.pieces(); ++i) table_.set(i, rate_at(i), rate_at(i + 1));
}

}  // namespace aeolian
