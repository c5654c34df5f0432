#include "aeolian_core/grains/dynamics/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aeolian {
namespace {

double shortest_contact(const ContactLaw& law, const StepInputs& in) {
  const double mass = in.least_mass / 2, radius = in.least_radius / 2;
  if (law.kind == ContactLaw::Kind::spring) {
    // Shear springs are quicker: rolling lends them a third of the mass (discs).
    const double stiffness = std::max(law.stiffness, law.shear_stiffness);
    const double damping = std::max(law.damping, law.shear_damping);
    return M_PI / std::max(std::sqrt(stiffness / mass), damping);
  }
  // A contact under load is as quick as the impact that would press it as far.
  const double modulus = law.youngs_modulus / (2 * (1 - law.poisson_ratio * law.poisson_ratio));
  const double pressed =
      std::sqrt(16 * modulus * std::sqrt(radius) * std::pow(in.overlap, 2.5) / (15 * mass));
  const double least = 1e-3 * std::sqrt(in.gravity * in.least_radius) + 1e-6;
  return contact_time(law, mass, radius, std::max({2 * in.speed, pressed, least}));
}

}  // namespace

double time_step(const ContactLaw& law, double steps_per_contact, double drag, const StepInputs& in) {
  if (in.least_mass == 0) return std::numeric_limits<double>::infinity();
  const double way = 0.1 * in.least_radius;
  const double contact = shortest_contact(law, in) / steps_per_contact;
  const double moving = 2 * way / (in.speed + std::sqrt(in.speed * in.speed + 2 * in.acceleration * way));
  const double dragged = 0.2 / drag;
  return std::min({contact, moving, dragged});
}

}  // namespace aeolian
