#include "aeolian_core/grains/splash/ungar_haff.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/grains/splash/bed_view.hpp"
#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

UngarHaffEjection::UngarHaffEjection(const Grain& grain, double coefficient, double speed)
    : unit_(std::sqrt(gravity * grain.diameter)), coefficient_(coefficient), speed_(speed) {
  check(grain);
  if (!(coefficient > 0) || !std::isfinite(coefficient))
    throw Error("Ungar and Haff's ejection: coefficient is " + std::to_string(coefficient) +
                ", must be positive and finite");
  if (!(speed > 0) || !std::isfinite(speed))
    throw Error("Ungar and Haff's ejection: speed is " + std::to_string(speed) +
                ", must be positive and finite");
}

double UngarHaffEjection::mean_number(const Impact& impact) const {
  const double speed = impact.speed / unit_;
  return coefficient_ * speed * speed;
}

void UngarHaffEjection::sample(const Impact& impact, RandomStream& random,
                               std::vector<LeavingGrain>& ejecta) const {
  const BedView bed(impact);
  for (int left = draw_rounded(mean_number(impact), random); left > 0; --left)
    ejecta.push_back({bed.velocity(0, speed_ * unit_), 1, 0, Origin::other});
}

}  // namespace aeolian
