#include "aeolian_core/saltation/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "aeolian_core/saltation/hermite.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr double flight_tolerance = 1e-4;
constexpr double part_of_layer = 0.25;  ///< a flight is cut into pieces of this height, about

/// Adds one step of a flight of `rate` grains per area and time.
void deposit(const FlightStep& s, double rate, double mass, double ground, SaltationProfiles& p) {
  const double pieces = std::ceil(std::abs(s.y1 - s.y0) / (part_of_layer * p.thickness)) + 1;
  const auto last = p.height.size() - 1;
  const double dt = s.duration / pieces;
  double vx0 = s.vx0;
  for (int i = 0; i < static_cast<int>(pieces); ++i) {
    const double middle = (i + 0.5) / pieces;
    const double y = hermite(middle, s.duration, s.y0, s.vy0, s.y1, s.vy1) - ground;
    const double vx = hermite(middle, s.duration, s.vx0, s.ax0, s.vx1, s.ax1);
    const double vy = hermite(middle, s.duration, s.vy0, s.ay0, s.vy1, s.ay1);
    const double vx1 = i + 1 == static_cast<int>(pieces)
                           ? s.vx1
                           : hermite((i + 1) / pieces, s.duration, s.vx0, s.ax0, s.vx1, s.ax1);
    const auto layer = std::min(static_cast<std::size_t>(std::max(0.0, y / p.thickness)), last);
    p.number_density[layer] += rate * dt;
    p.number_flux[layer] += rate * vx * dt;
    p.cubed_flux[layer] += rate * vx * vx * vx * dt;
    p.kinetic_flux[layer] += 0.5 * mass * rate * vx * (vx * vx + vy * vy) * dt;
    p.drag[layer] += rate * mass * (vx1 - vx0);
    vx0 = vx1;
  }
}

}  // namespace

double SaltationProfiles::mass_flux(double grain_mass) const {
  return grain_mass * thickness * std::accumulate(number_flux.begin(), number_flux.end(), 0.0);
}

double SaltationProfiles::stress() const {
  return thickness * std::accumulate(drag.begin(), drag.end(), 0.0);
}

double SaltationProfiles::peak(const std::vector<double>& column, double layer) const {
  const auto together = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(layer / thickness)));
  double best = 0;
  double at = 0;
  for (std::size_t i = 0; i + together <= column.size(); i += together) {
    const auto begin = column.begin() + static_cast<std::ptrdiff_t>(i);
    const double sum = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(together), 0.0);
    if (sum <= best) continue;
    best = sum;
    at = (static_cast<double>(i) + 0.5 * static_cast<double>(together)) * thickness;
  }
  return at;
}

double SaltationProfiles::median_height(const std::vector<double>& column) const {
  const double half = 0.5 * std::accumulate(column.begin(), column.end(), 0.0);
  double below = 0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (below + column[i] >= half && column[i] > 0)
      return (static_cast<double>(i) + (half - below) / column[i]) * thickness;
    below += column[i];
  }
  return 0;
}

SaltationProfiles profiles(const SteadyState& state, const SaltatingBed& bed, double thickness) {
  double apex = 0;
  for (std::size_t k = 0; k < state.launches.size(); ++k)
    if (state.launches.number[k] > 0) apex = std::max(apex, state.landings.apex[k]);
  if (!(thickness > 0 && apex / thickness < 1e6))
    throw Error("saltation profiles: the thickness of layers is " + std::to_string(thickness) +
                " m, must be positive and not below a millionth of " + std::to_string(apex) + " m");
  SaltationProfiles p;
  p.thickness = thickness;
  const auto layers = static_cast<std::size_t>(std::ceil(apex / thickness)) + 1;
  const double ground = state.wind.roughness();
  for (auto* column : {&p.number_density, &p.number_flux, &p.cubed_flux, &p.kinetic_flux, &p.drag})
    column->assign(layers, 0);
  for (std::size_t i = 0; i < layers; ++i) {
    p.height.push_back((static_cast<double>(i) + 0.5) * thickness);
    p.wind.push_back(state.wind.speed(p.height[i] + ground));
    p.undisturbed_wind.push_back(state.friction_velocity / von_karman * std::log1p(p.height[i] / ground));
  }

  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, bed.drag_scale);
  for (std::size_t k = 0; k < state.launches.size(); ++k) {
    const double rate = state.launches.number[k];
    if (!(rate > 0)) continue;
    for (const FlightStep& step : trace(state.launches.vx[k], state.launches.vy[k],
                                        {state.wind, drag, bed.atmosphere.gravity, flight_tolerance}))
      deposit(step, rate, state.grain_mass, ground, p);
  }
  for (auto* column : {&p.number_density, &p.number_flux, &p.cubed_flux, &p.kinetic_flux, &p.drag})
    for (double& value : *column) value /= thickness;
  return p;
}

}  // namespace aeolian
