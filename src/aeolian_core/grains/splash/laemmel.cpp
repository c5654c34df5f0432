#include "aeolian_core/grains/splash/laemmel.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/ejecta_direction.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

struct PairOfGrains {
  double alpha, beta;   ///< what is left of the normal speed, turned about, and of the tangential one
  double bed_diameter;  ///< over the mean of both
};

PairOfGrains pair_of(const LaemmelParameters& p, double size_ratio) {
  const double mass = size_ratio * size_ratio * size_ratio;
  const double mu = p.normal * mass / (mass + p.normal);
  return {(1 + p.normal) / (1 + mu) - 1, 1 - 2.0 / 7 * (1 - p.tangential) / (1 + mu), 2 / (1 + size_ratio)};
}

double restitution_of(const PairOfGrains& pair, double angle) {
  return std::max(0.0, pair.beta - (pair.beta * pair.beta - pair.alpha * pair.alpha) * pair.bed_diameter *
                                       angle / (2 * pair.beta));
}

}  // namespace

void LaemmelParameters::require_valid() const {
  if (!(normal > 0 && normal <= 1))
    throw Error("Laemmel's splash: normal restitution is " + std::to_string(normal) +
                ", must be above 0, to 1");
  if (!(tangential >= -1 && tangential <= 1))
    throw Error("Laemmel's splash: tangential restitution is " + std::to_string(tangential) +
                ", must be -1 to 1");
}

LaemmelRebound::LaemmelRebound(const LaemmelParameters& parameters) : parameters_(parameters) {
  parameters.require_valid();
}

double LaemmelRebound::restitution(double angle, double size_ratio) const {
  return restitution_of(pair_of(parameters_, size_ratio), angle);
}

// The density of w = gamma (in + out)^2 / (2 in) is -ln w from 0 to 1: that of the product of two uniform
// numbers.
std::optional<LeavingGrain> LaemmelRebound::sample(const Impact& impact, RandomStream& random) const {
  const BedView bed(impact);
  const PairOfGrains pair = pair_of(parameters_, impact.size_ratio);
  const double steepness = pair.beta / (pair.alpha + pair.beta);
  const double gamma = 4.0 / 9 / pair.bed_diameter * steepness * steepness;
  const double w = random.uniform() * random.uniform();
  const double elevation = std::sqrt(2 * bed.angle() * w / gamma) - bed.angle();
  const double speed = impact.speed * restitution_of(pair, bed.angle());
  if (elevation <= 0 || elevation >= M_PI || speed == 0) return std::nullopt;
  LeavingGrain grain = ejected(bed, speed, elevation);
  grain.size_ratio = impact.size_ratio;
  grain.origin = Origin::rebound;
  return grain;
}

LaemmelEjection::LaemmelEjection(const Grain& grain, const LaemmelParameters& parameters)
    : rebound_(parameters), unit2_(gravity * grain.diameter) {
  check(grain);
}

LaemmelEjection::Energies LaemmelEjection::energies(const Impact& impact) const {
  const double restitution = rebound_.restitution(BedView(impact).angle(), impact.size_ratio);
  const double energy = (1 - restitution * restitution) * kinetic_energy(impact) / unit2_;
  if (energy <= 1) return {0, 0, 0};
  const double order = std::log(energy);
  const double middle = order * (1 - 2 * M_LN2);
  const double width = std::sqrt(2 * order) * M_LN2;
  const double mean = std::exp(middle + width * width / 2);
  return {middle, width, 0.06 * energy / (2 * mean) * std::erfc(-middle / (M_SQRT2 * width))};
}

double LaemmelEjection::mean_number(const Impact& impact) const { return energies(impact).number; }

double LaemmelEjection::mean_speed(const Impact& impact) const {
  const Energies e = energies(impact);
  if (e.width == 0) return 0;
  const double low = -e.middle / (M_SQRT2 * e.width);
  return std::sqrt(2 * unit2_) * std::exp(e.middle / 2 + e.width * e.width / 8) *
         std::erfc(low - e.width / (2 * M_SQRT2)) / std::erfc(low);
}

void LaemmelEjection::sample(const Impact& impact, RandomStream& random,
                             std::vector<LeavingGrain>& ejecta) const {
  const Energies e = energies(impact);
  const int count = draw_poisson(e.number, random);
  if (count == 0) return;
  const BedView bed(impact);
  for (int i = 0; i < count; ++i) {
    const double energy = std::exp(e.middle + e.width * draw_normal_above(-e.middle / e.width, random));
    ejecta.push_back(
        ejected(bed, std::sqrt(2 * unit2_ * energy), draw_elevation(mean_ejecta_elevation, random)));
  }
}

}  // namespace aeolian
