#include "aeolian_core/grains/impacts/bed_state.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

/// The part of a disc (area) or sphere (volume) around height z that lies below `level`.
template <int Dim>
double part_below(double z, double radius, double level) {
  const double h = std::clamp(level - z, -radius, radius);
  if constexpr (Dim == 2)
    return radius * radius * (M_PI - std::acos(h / radius)) + h * std::sqrt(radius * radius - h * h);
  else
    return M_PI * (2. / 3 * radius * radius * radius + radius * radius * h - h * h * h / 3);
}

}  // namespace

template <int Dim>
BedState bed_state(const GrainDynamics<Dim>& grains, const BedSurface& surface, double radius, double length,
                   double width) {
  const double low = 2 * radius;
  const double high = std::max(surface.mean_height() - 2 * radius, low + radius);
  const double count = static_cast<double>(grains.size());
  const double weight = -grains.world().acceleration[Dim - 1];
  double solid = 0;
  double mass = 0;
  for (const int grain : grains.numbers()) {
    const double z = grains.position(grain)[Dim - 1];
    const double r = grains.radius(grain);
    solid += part_below<Dim>(z, r, high) - part_below<Dim>(z, r, low);
    mass += grains.mass(grain);
  }
  // The energy in a contact at rest: the work of a force that grows as overlap, or as its power of 3 / 2.
  const double work = grains.world().law.kind == ContactLaw::Kind::spring ? 0.5 : 0.4;
  double overlap = 0;
  double pairs = 0;
  for (const auto& contact : grains.contacts()) {
    overlap += work * std::abs(contact.normal_force) * contact.overlap;
    if (contact.second >= 0) ++pairs;
  }
  const double unit = mass * weight * 2 * radius;
  const double space = (high - low) * length * (Dim == 3 ? width : 1);
  return {static_cast<int>(grains.size()), solid / space,  2 * pairs / count,
          grains.kinetic_energy() / unit,  overlap / unit, surface.roughness()};
}

template BedState bed_state(const GrainDynamics<2>&, const BedSurface&, double, double, double);
template BedState bed_state(const GrainDynamics<3>&, const BedSurface&, double, double, double);

}  // namespace aeolian
