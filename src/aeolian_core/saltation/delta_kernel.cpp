#include "aeolian_core/saltation/delta_kernel.hpp"

#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

DeltaKernel::DeltaKernel(const Grain& grain, const Atmosphere& atmosphere, double coefficient, double speed)
    : coefficient_(coefficient), speed_(speed) {
  check(grain);
  check(atmosphere);
  if (!(coefficient > 0 && std::isfinite(coefficient)) || !(speed > 0 && std::isfinite(speed)))
    throw Error("delta splash: coefficient and speed are " + std::to_string(coefficient) + " and " +
                std::to_string(speed) + ", must be positive");
  scale_ = std::sqrt(atmosphere.gravity * grain.diameter);
}

void DeltaKernel::launch(const std::vector<double>& spectrum, Launches& launches) const {
  launches.vx = {0};
  launches.vy = {speed_ * scale_};
  launches.number = spectrum;
}

void DeltaKernel::splash(const Launches& launches, double, const Landings& landings,
                         std::vector<double>& spectrum) const {
  const double energy = landings.vx[0] * landings.vx[0] + landings.vy[0] * landings.vy[0];
  spectrum = {launches.number[0] * coefficient_ * energy / (scale_ * scale_)};
}

}  // namespace aeolian
