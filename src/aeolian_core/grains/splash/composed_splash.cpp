#include "aeolian_core/grains/splash/composed_splash.hpp"

#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// What a rebound may differ from its impact by rounding.
constexpr double rounding = 1e-9;

/// What an event may still take of its impact.
class Allowance {
 public:
  explicit Allowance(const Impact& impact)
      : cosine_(std::cos(impact.angle)),
        sine_(std::sin(impact.angle)),
        energy_(kinetic_energy(impact) * (1 + rounding)),
        momentum_(momentum(impact) * (1 + rounding)) {}

  bool covers(const LeavingGrain& grain) const {
    return energy_of(grain) <= energy_ && momentum_of(grain) <= momentum_;
  }
  void take(const LeavingGrain& grain) {
    energy_ -= energy_of(grain);
    momentum_ -= momentum_of(grain);
  }

 private:
  static double mass(const LeavingGrain& grain) {
    return grain.size_ratio * grain.size_ratio * grain.size_ratio;
  }
  static double energy_of(const LeavingGrain& grain) {
    return mass(grain) * grain.velocity.squaredNorm() / 2;
  }
  double momentum_of(const LeavingGrain& grain) const {
    return mass(grain) * (cosine_ * grain.velocity.x() - sine_ * grain.velocity.z());
  }

  double cosine_, sine_, energy_, momentum_;
};

}  // namespace

// By Cauchy and Schwarz the momentum of grains of mass M and energy E is at most sqrt(2 M E): where that is
// less than the impact's, its direction does not matter.
bool within_impact(const SplashEvent& event, const Impact& impact) {
  double all_mass = 0;
  const auto add = [&](const LeavingGrain& grain) {
    all_mass += grain.size_ratio * grain.size_ratio * grain.size_ratio;
  };
  if (event.rebound) add(*event.rebound);
  for (const LeavingGrain& grain : event.ejecta) add(grain);
  const double energy = kinetic_energy(event);
  const double brought = kinetic_energy(impact) * (1 + rounding);
  if (energy > brought) return false;
  if (all_mass * energy <= brought * impact.size_ratio * impact.size_ratio * impact.size_ratio) return true;
  return momentum_along(impact, event) <= momentum(impact) * (1 + rounding);
}

void drop_beyond_impact(SplashEvent& event, const Impact& impact) {
  Allowance left(impact);
  if (event.rebound) left.take(*event.rebound);
  std::size_t kept = 0;
  for (const LeavingGrain& grain : event.ejecta) {
    if (!left.covers(grain)) continue;
    left.take(grain);
    event.ejecta[kept++] = grain;
  }
  event.ejecta.resize(kept);
}

ComposedSplash::ComposedSplash(std::shared_ptr<const Rebound> rebound,
                               std::shared_ptr<const Ejection> ejection)
    : rebound_(std::move(rebound)), ejection_(std::move(ejection)) {
  if (!rebound_ || !ejection_) throw Error("splash: rebound or ejection is missing, must be given");
}

void ComposedSplash::draw(const Impact& impact, RandomStream& random, SplashEvent& event) const {
  event.rebound = rebound_->sample(impact, random);
  constexpr int tries = 4;
  for (int i = 0; i < tries; ++i) {
    event.ejecta.clear();
    ejection_->sample(impact, random, event.ejecta);
    if (event.ejecta.empty() || within_impact(event, impact)) return;
  }
  drop_beyond_impact(event, impact);
}

}  // namespace aeolian
