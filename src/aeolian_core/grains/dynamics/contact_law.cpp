#include "aeolian_core/grains/dynamics/contact_law.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "aeolian_core/grains/dynamics/contact_force.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

void refuse(const char* name, double value, const char* allowed) {
  std::string text = std::string("contact law: ") + name + " is ";
  append_number(text, value);
  throw Error(text + ", allowed is " + allowed);
}

void require_positive(const char* name, double value) {
  if (!(value > 0 && std::isfinite(value))) refuse(name, value, "a positive number");
}

void require_not_negative(const char* name, double value) {
  if (!(value >= 0 && std::isfinite(value))) refuse(name, value, "zero or a positive number");
}

/// Damping over critical that gives a restitution.
double damping_ratio(double restitution) {
  const double log = -std::log(restitution);
  return log / std::hypot(M_PI, log);
}

double effective_modulus(const ContactLaw& law) {
  return law.youngs_modulus / (2 * (1 - law.poisson_ratio * law.poisson_ratio));
}

}  // namespace

ContactLaw ContactLaw::spring(double stiffness, double restitution, double effective_mass, double friction) {
  require_positive("stiffness", stiffness);
  require_positive("effective mass", effective_mass);
  if (!(restitution > 0 && restitution <= 1)) refuse("restitution", restitution, "above 0 and up to 1");
  ContactLaw law;
  law.stiffness = law.shear_stiffness = stiffness;
  law.damping = law.shear_damping = 2 * damping_ratio(restitution) * std::sqrt(stiffness / effective_mass);
  law.friction = friction;
  law.require_valid();
  return law;
}

void ContactLaw::require_valid() const {
  require_not_negative("friction", friction);
  if (kind == Kind::spring) {
    require_positive("stiffness", stiffness);
    require_not_negative("shear stiffness", shear_stiffness);
    require_not_negative("damping", damping);
    require_not_negative("shear damping", shear_damping);
  } else {
    require_positive("Young's modulus", youngs_modulus);
    if (!(poisson_ratio > -1 && poisson_ratio <= 0.5))
      refuse("Poisson's ratio", poisson_ratio, "above -1 and up to 0.5");
    if (!(restitution > 0 && restitution <= 1)) refuse("restitution", restitution, "above 0 and up to 1");
  }
}

double restitution(double stiffness, double damping, double effective_mass) {
  const double rate = stiffness / effective_mass - damping * damping / 4;
  return rate > 0 ? std::exp(-damping * M_PI / (2 * std::sqrt(rate))) : 0;
}

double contact_time(const ContactLaw& law, double effective_mass, double effective_radius, double speed) {
  if (law.kind == ContactLaw::Kind::spring) {
    const double rate = law.stiffness / effective_mass - law.damping * law.damping / 4;
    return rate > 0 ? M_PI / std::sqrt(rate) : std::numeric_limits<double>::infinity();
  }
  const double modulus = effective_modulus(law);
  return 2.87 *
         std::pow(effective_mass * effective_mass / (effective_radius * modulus * modulus * speed), 0.2);
}

LawConstants::LawConstants(const ContactLaw& law)
    : hertz(law.kind == ContactLaw::Kind::hertz_mindlin),
      stiffness(law.stiffness),
      damping(law.damping),
      shear_stiffness(law.shear_stiffness),
      shear_compliance(law.shear_stiffness > 0 ? 1 / law.shear_stiffness : 0),
      shear_damping(law.shear_damping),
      modulus(4.0 / 3 * effective_modulus(law)),
      // 8 G* with 1 / G* = 2 (2 - nu) / G (Mindlin 1949)
      shear_modulus(2 * law.youngs_modulus / ((1 + law.poisson_ratio) * (2 - law.poisson_ratio))),
      // The closed form of Antypov & Elliott (2011).
      loss(std::sqrt(5.0) * damping_ratio(law.restitution)),
      friction(law.friction) {}

}  // namespace aeolian
