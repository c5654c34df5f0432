#include "aeolian_core/grains/splash/splash.hpp"

#include <cmath>

#include "aeolian_core/grains/splash/reptation.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

double mass(double size_ratio) { return size_ratio * size_ratio * size_ratio; }

constexpr Require require{"impact"};

}  // namespace

void check(const Impact& impact) {
  require(impact.speed > 0 && std::isfinite(impact.speed), "speed", impact.speed,
          "positive and finite [m/s]");
  require(impact.angle_to_bed() > 0 && impact.angle_to_bed() < M_PI, "angle to the bed",
          impact.angle_to_bed(), "between 0 and pi [rad]");
  require(std::abs(impact.slope) < M_PI / 2, "slope", impact.slope, "between -pi/2 and pi/2 [rad]");
  require(impact.size_ratio > 0 && std::isfinite(impact.size_ratio), "size ratio", impact.size_ratio,
          "positive and finite");
}

const char* name_of(Origin origin) {
  switch (origin) {
    case Origin::rebound:
      return "rebound";
    case Origin::target:
      return "target";
    case Origin::brink:
      return "brink";
    case Origin::anti_brink:
      return "anti_brink";
    case Origin::other:
      break;
  }
  return "other";
}

double kinetic_energy(const SplashEvent& event) {
  double energy = 0;
  if (event.rebound) energy += mass(event.rebound->size_ratio) * event.rebound->velocity.squaredNorm();
  for (const LeavingGrain& grain : event.ejecta)
    energy += mass(grain.size_ratio) * grain.velocity.squaredNorm();
  return energy / 2;
}

double kinetic_energy(const Impact& impact) {
  return mass(impact.size_ratio) * impact.speed * impact.speed / 2;
}

double momentum_along(const Impact& impact, const SplashEvent& event) {
  const Eigen::Vector3d path(std::cos(impact.angle), 0, -std::sin(impact.angle));
  double sum = 0;
  if (event.rebound) sum += mass(event.rebound->size_ratio) * event.rebound->velocity.dot(path);
  for (const LeavingGrain& grain : event.ejecta) sum += mass(grain.size_ratio) * grain.velocity.dot(path);
  return sum;
}

double momentum(const Impact& impact) { return mass(impact.size_ratio) * impact.speed; }

double reptation_distance(const SplashEvent& event, double slope) {
  double sum = 0;
  for (const LeavingGrain& grain : event.ejecta)
    sum += hop_length(grain.velocity.x(), grain.velocity.z(), slope);
  return sum;
}

}  // namespace aeolian
