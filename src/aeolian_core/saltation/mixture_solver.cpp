#include "aeolian_core/saltation/mixture_solver.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

SaltatingBed with_diameter(SaltatingBed bed, double diameter) {
  bed.roughness = bed.roughness_length();
  bed.grain.diameter = diameter;
  return bed;
}

SaltatingBed mean_bed(SaltatingBed bed, const GrainMixture& mixture) {
  check(mixture);
  bed.grain.diameter = mixture.mean_diameter();
  check(bed);
  return bed;
}

Drag drag_of(const SaltatingBed& bed) { return {bed.drag_law, bed.grain, bed.atmosphere, bed.drag_scale}; }

FlyingGrains grains_of(const SaltatingBed& mean, const GrainMixture& mixture) {
  std::vector<Drag> drag;
  std::vector<double> mass;
  for (const double diameter : mixture.diameter) {
    const SaltatingBed own = with_diameter(mean, diameter);
    drag.push_back(drag_of(own));
    mass.push_back(own.grain.mass() / mean.grain.mass());
  }
  return {std::move(drag), std::move(mass), *std::min_element(mixture.share.begin(), mixture.share.end())};
}

}  // namespace

double MixtureState::mass_flux() const {
  double sum = 0;
  for (const SteadyState& size : sizes) sum += size.mass_flux();
  return sum;
}

double MixtureState::impact_rate() const {
  double sum = 0;
  for (const SteadyState& size : sizes) sum += size.impact_rate();
  return sum;
}

MixtureSolver::MixtureSolver(const SaltatingBed& bed, const GrainMixture& mixture,
                             const SolverSettings& settings, const KokRennoConstants& constants,
                             int speeds_per_octave, int angles)
    : bed_(mean_bed(bed, mixture)),
      mixture_(mixture),
      settings_(settings),
      solver_(bed_, grains_of(bed_, mixture),
              MixtureKernel(mixture, bed_.grain, bed_.atmosphere, constants, speeds_per_octave, angles),
              settings) {}

SaltatingBed MixtureSolver::bed_of(std::size_t size) const {
  return with_diameter(bed_, mixture_.diameter.at(size));
}

MixtureState MixtureSolver::solve(double friction_velocity) const {
  const SteadyState all = solver_.solve(friction_velocity);
  MixtureState state;
  const std::size_t sizes = mixture_.diameter.size();
  for (std::size_t s = 0; s < sizes; ++s) {
    const SaltatingBed bed = bed_of(s);
    SteadyState own = all;
    own.launches = part_of(all.launches, s, sizes);
    own.landings = part_of(all.landings, s, sizes);
    own.grain_mass = bed.grain.mass();
    own.grain_stress.assign(WindProfile::levels, 0);
    if (all.steady()) {
      // The share of this size in the stress is not kept by the solver: flown once more in the same wind.
      fly(own.launches, 0, {own.wind, drag_of(bed), bed.atmosphere.gravity, settings_.flight_tolerance},
          own.landings, own.grain_stress);
      for (double& stress : own.grain_stress) stress *= own.grain_mass;
    }
    state.sizes.push_back(std::move(own));
  }
  return state;
}

}  // namespace aeolian
