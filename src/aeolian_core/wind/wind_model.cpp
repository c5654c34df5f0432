#include "aeolian_core/wind/wind_model.hpp"

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {

LogLawWind::LogLawWind(double roughness) : roughness_(roughness) {
  if (!(roughness > 0) || !std::isfinite(roughness))
    throw Error("log law: the roughness length is " + std::to_string(roughness) + " m, must be positive");
}

WindField LogLawWind::solve(const WindInput& input, const HeightMap* /*surface*/) {
  if (!std::isfinite(input.direction)) throw Error("wind: the direction is not a finite number");
  if (!(input.air_density > 0) || !std::isfinite(input.air_density))
    throw Error("wind: the air density is " + std::to_string(input.air_density) +
                " kg/m^3, must be positive");
  WindField field;
  field.friction_velocity = friction_velocity(input.speed, input.height, roughness_);
  field.direction = wrap_angle(input.direction);
  field.air_density = input.air_density;
  field.model = "log law";
  return field;
}

}  // namespace aeolian
