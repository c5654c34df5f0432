#include "aeolian_core/grains/impacts/impact_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double from_vertical(const Eigen::Vector3d& velocity) { return std::atan2(velocity.x(), velocity.z()); }

/// Collects one number an impact.
class Collection {
 public:
  void add(double value) {
    if (std::isfinite(value)) values_.push_back(value);
  }
  MeanValue mean() const { return mean_value(values_); }
  const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;
};

void add_rebounds(const std::vector<const ImpactOutcome*>& outcomes, ImpactStatistics& s) {
  Collection along, up, speed, angle, rolling, normal, bed_along, bed_down, bed_angle, mass;
  for (const ImpactOutcome* o : outcomes) {
    normal.add(o->contact->normal_angle);
    mass.add(o->contact->effective_mass);
    if (!o->rebound) {
      ++s.captured;
      continue;
    }
    const double in_x = o->shot.speed * std::cos(o->shot.angle);
    const double in_z = o->shot.speed * std::sin(o->shot.angle);
    const Eigen::Vector3d& v = o->rebound->velocity;
    if (v.x() < 0) ++s.backward;
    along.add(v.x() / in_x);
    up.add(v.z() / in_z);
    speed.add(v.norm() / o->shot.speed);
    angle.add(from_vertical(v));
    rolling.add(o->rebound->spin * o->rebound->radius / std::abs(v.x()));
    bed_along.add(1 - v.x() / in_x);
    bed_down.add(1 + v.z() / in_z);
    bed_angle.add(std::atan2(in_z + v.z(), in_x - v.x()));
  }
  s.along = along.mean();
  s.up = up.mean();
  s.speed = speed.mean();
  s.rebound_angle = angle.mean();
  s.rolling = rolling.mean();
  s.normal_angle = normal.mean();
  s.bed_along = bed_along.mean();
  s.bed_down = bed_down.mean();
  s.bed_angle = bed_angle.mean();
  s.effective_mass = mass.mean();
  std::vector<double> masses = mass.values();
  s.effective_mass_median = masses.empty() ? unknown : median(masses);
}

/// Values of ejecta, impact by impact.
template <class Value>
MeanValue over_ejecta(const std::vector<const ImpactOutcome*>& outcomes, Value value) {
  std::vector<std::vector<double>> groups;
  groups.reserve(outcomes.size());
  for (const ImpactOutcome* o : outcomes) {
    groups.emplace_back();
    for (const RisenGrain& grain : o->ejecta) groups.back().push_back(value(grain));
  }
  return pooled_mean(groups);
}

/// Sums over the ejecta of each impact, for which value may depend on both.
template <class Value>
MeanValue over_impacts(const std::vector<const ImpactOutcome*>& outcomes, Value value) {
  Collection sums;
  for (const ImpactOutcome* o : outcomes) {
    double sum = 0;
    for (const RisenGrain& grain : o->ejecta) sum += value(*o, grain);
    sums.add(sum);
  }
  return sums.mean();
}

EjectaShare share_of(Origin kind, const std::vector<const ImpactOutcome*>& outcomes, double radius, int dim) {
  const auto momentum = [&](const ImpactOutcome& o, const RisenGrain& grain) {
    return std::pow(grain.radius / radius, dim) / o.incident_mass * grain.velocity.x() /
           (o.shot.speed * std::cos(o.shot.angle));
  };
  std::vector<std::vector<double>> angles;
  for (const ImpactOutcome* o : outcomes) {
    angles.emplace_back();
    for (const RisenGrain& grain : o->ejecta)
      if (grain.kind == kind) angles.back().push_back(from_vertical(grain.velocity));
  }
  const auto of_kind = [&](auto value) {
    return over_impacts(outcomes, [&, value](const ImpactOutcome& o, const RisenGrain& grain) {
      return grain.kind == kind ? value(o, grain) : 0;
    });
  };
  return {of_kind([](const ImpactOutcome&, const RisenGrain&) { return 1.; }), pooled_mean(angles),
          of_kind(momentum), of_kind([](const ImpactOutcome&, const RisenGrain& grain) {
            return ballistic_hop(grain.velocity);
          })};
}

void add_ejecta(const std::vector<const ImpactOutcome*>& outcomes, double radius, int dim,
                ImpactStatistics& s) {
  const auto share = [&](const ImpactOutcome& o, const RisenGrain& grain) {
    return std::pow(grain.radius / radius, dim) / o.incident_mass;
  };
  s.ejecta_speed = over_ejecta(outcomes, [](const RisenGrain& g) { return g.velocity.norm(); });
  s.ejecta_upward = over_ejecta(outcomes, [](const RisenGrain& g) { return g.velocity.z(); });
  s.ejecta_angle = over_ejecta(outcomes, [](const RisenGrain& g) { return from_vertical(g.velocity); });
  s.origin_along = over_ejecta(outcomes, [](const RisenGrain& g) { return g.origin.x(); });
  s.origin_up = over_ejecta(outcomes, [](const RisenGrain& g) { return g.origin.z(); });
  s.origin_distance = over_ejecta(outcomes, [](const RisenGrain& g) { return g.origin.norm(); });
  s.from_upper_layers =
      over_ejecta(outcomes, [](const RisenGrain& g) { return g.layer <= 2 ? 1. : 0.; }).mean;
  s.number = over_impacts(outcomes, [](const ImpactOutcome&, const RisenGrain&) { return 1.; });
  s.reptation = over_impacts(
      outcomes, [](const ImpactOutcome&, const RisenGrain& g) { return ballistic_hop(g.velocity); });
  s.ejected_along = over_impacts(outcomes, [&](const ImpactOutcome& o, const RisenGrain& g) {
    return share(o, g) * g.velocity.x() / o.shot.speed;
  });
  s.ejected_up = over_impacts(outcomes, [&](const ImpactOutcome& o, const RisenGrain& g) {
    return share(o, g) * g.velocity.z() / o.shot.speed;
  });
  s.ejected_energy = over_impacts(outcomes, [&](const ImpactOutcome& o, const RisenGrain& g) {
    return share(o, g) * g.velocity.squaredNorm() / (o.shot.speed * o.shot.speed);
  });
  Collection bed_energy;
  for (const ImpactOutcome* o : outcomes) {
    double left = 1;
    if (o->rebound) left -= o->rebound->velocity.squaredNorm() / (o->shot.speed * o->shot.speed);
    for (const RisenGrain& g : o->ejecta)
      left -= share(*o, g) * g.velocity.squaredNorm() / (o->shot.speed * o->shot.speed);
    bed_energy.add(left);
  }
  s.bed_energy = bed_energy.mean();
  for (const Origin kind : ejecta_origins) s.by_origin[kind] = share_of(kind, outcomes, radius, dim);
}

}  // namespace

MeanValue mean_value(const std::vector<double>& values) {
  std::vector<std::vector<double>> groups;
  groups.reserve(values.size());
  for (const double value : values) groups.push_back({value});
  return pooled_mean(groups);
}

MeanValue pooled_mean(const std::vector<std::vector<double>>& groups) {
  double sum = 0;
  double count = 0;
  for (const auto& group : groups) {
    sum += std::accumulate(group.begin(), group.end(), 0.0);
    count += static_cast<double>(group.size());
  }
  if (count == 0) return {unknown, unknown, unknown, 0};
  const double mean = sum / count;
  double squares = 0;
  double residuals = 0;
  for (const auto& group : groups) {
    double residual = 0;
    for (const double value : group) {
      squares += (value - mean) * (value - mean);
      residual += value - mean;
    }
    residuals += residual * residual;
  }
  const double n = static_cast<double>(groups.size());
  return {mean, count > 1 ? std::sqrt(squares / (count - 1)) : unknown,
          n > 1 ? std::sqrt(residuals * n / (n - 1)) / count : unknown, static_cast<int>(count)};
}

template <int Dim>
ImpactStatistics impact_statistics(const std::vector<ImpactOutcome>& outcomes, const Bed<Dim>& bed) {
  std::vector<const ImpactOutcome*> met;
  for (const ImpactOutcome& outcome : outcomes)
    if (outcome.contact) met.push_back(&outcome);
  ImpactStatistics statistics;
  statistics.impacts = static_cast<int>(met.size());
  add_rebounds(met, statistics);
  add_ejecta(met, bed.radius, Dim, statistics);
  return statistics;
}

template ImpactStatistics impact_statistics(const std::vector<ImpactOutcome>&, const Bed<2>&);
template ImpactStatistics impact_statistics(const std::vector<ImpactOutcome>&, const Bed<3>&);

}  // namespace aeolian
