#include "aeolian_core/bedforms/height_map/wavelength_law.hpp"

#include <cmath>

#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double checked(double diameters) {
  if (!(diameters > 0) || !std::isfinite(diameters))
    throw Error("wavelength law: the final wavelength is " + std::to_string(diameters) +
                " grain diameters, must be positive and finite");
  return diameters;
}

}  // namespace

ConstantWavelength::ConstantWavelength(double diameters) : diameters_(checked(diameters)) {}

double ConstantWavelength::final_wavelength(const Forcing& forcing) const {
  return diameters_ * forcing.grain.diameter;
}

LinearWavelength::LinearWavelength(double diameters_at_twice_threshold)
    : diameters_(checked(diameters_at_twice_threshold)) {}

double LinearWavelength::final_wavelength(const Forcing& forcing) const {
  if (!(forcing.friction_velocity > 0))
    throw Error(
        "wavelength law: the forcing's friction velocity is not set, must be positive for the law that is "
        "linear in it");
  const double threshold = steady_saltation(forcing.friction_velocity, forcing.grain).impact_threshold;
  return diameters_ * forcing.grain.diameter * (forcing.friction_velocity / threshold - 1);
}

std::shared_ptr<const WavelengthLaw> make_wavelength_law(const std::string& name, double diameters) {
  if (name == "none") return nullptr;
  if (name == "constant") return std::make_shared<ConstantWavelength>(diameters);
  if (name == "linear") return std::make_shared<LinearWavelength>(diameters);
  throw Error("wavelength law: there is none called '" + name + "', must be none, constant or linear");
}

}  // namespace aeolian
