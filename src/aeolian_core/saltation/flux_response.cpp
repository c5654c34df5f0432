#include "aeolian_core/saltation/flux_response.hpp"

#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

FluxResponse::FluxResponse(const FluxLaw& law, double start, double time)
    : law_(law), switch_(start, law.threshold), time_(time) {
  if (!(time > 0 && std::isfinite(time)))
    throw Error("flux response: the time is " + std::to_string(time) + " s, must be positive");
}

double FluxResponse::advance(double duration, double friction_velocity) {
  if (!(duration >= 0 && std::isfinite(duration)))
    throw Error("flux response: the duration is " + std::to_string(duration) + " s, must be zero or more");
  if (!(friction_velocity >= 0 && std::isfinite(friction_velocity)))
    throw Error("flux response: friction velocity is " + std::to_string(friction_velocity) +
                " m/s, must be zero or more");
  const double saturated = switch_.update(friction_velocity) ? law_.flux(friction_velocity) : 0;
  flux_ = saturated + (flux_ - saturated) * std::exp(-duration / time_);
  return flux_;
}

double saturation_length(const SaltatingBed& bed) {
  check(bed);
  return 2.2 * bed.grain.diameter * bed.grain.density / bed.atmosphere.density;
}

double flux_at_fetch(double saturated, double fetch, double length) {
  if (!(fetch >= 0) || !(length > 0))
    throw Error("flux: fetch and saturation length are " + std::to_string(fetch) + " m and " +
                std::to_string(length) + " m, must be zero or more and positive");
  return saturated * -std::expm1(-fetch / length);
}

}  // namespace aeolian
