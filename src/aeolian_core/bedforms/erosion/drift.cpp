#include "aeolian_core/bedforms/erosion/drift.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/erosion/bounce.hpp"
#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr Require require{"erosion"};
constexpr double level_ratio = 0.05;  ///< of friction velocity between neighbouring tables of hops
constexpr int followed = 2000;        ///< parcels whose mean is the reach
constexpr int most_hops = 10000;

}  // namespace

Drift::Drift(const WindField& wind, const ErodibleBed& bed, const Grain& grain, const ErosionParameters& p)
    : parameters_(p),
      grain_(grain),
      parcel_(bed.parcel()),
      cell_area_(bed.geometry().cell() * bed.geometry().cell()) {
  const auto physical = [](double u) { return u >= 0 && u <= 10; };
  require(physical(wind.friction_velocity), "friction velocity", wind.friction_velocity, "0 to 10 m/s");
  require(std::isfinite(wind.direction), "direction", wind.direction, "finite");
  const auto cell_of = [](double u, double direction) {
    return Cell{static_cast<float>(u), static_cast<float>(std::cos(direction)),
                static_cast<float>(std::sin(direction))};
  };
  everywhere_ = cell_of(wind.friction_velocity, wind.direction);
  strongest_ = wind.friction_velocity;
  if (wind.cells.has("friction_velocity")) {
    const GridGeometry& g = bed.geometry();
    if (wind.cells.geometry() != g) throw Error("erosion: the wind's map is not that of the bed");
    const HeightMap::Layer& speed = wind.cells.layer("friction_velocity");
    const HeightMap::Layer* direction =
        wind.cells.has("direction") ? &wind.cells.layer("direction") : nullptr;
    strongest_ = 0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double u = std::isfinite(speed[i]) ? speed[i] : 0;
      require(physical(u), "friction velocity of a cell", u, "0 to 10 m/s");
      const bool turned = direction && std::isfinite((*direction)[i]);
      cells_.push_back(cell_of(u, turned ? (*direction)[i] : wind.direction));
      strongest_ = std::max(strongest_, u);
    }
    shear_.resize(2 * static_cast<std::size_t>(bed.stride()) * static_cast<std::size_t>(g.ny() + 1));
    for (int y = 0; y <= g.ny(); ++y)
      for (int x = 0; x <= g.nx(); ++x) {
        const int cx = x < g.nx() ? x : bed.periodic() ? 0 : g.nx() - 1;
        const int cy = y < g.ny() ? y : bed.periodic() ? 0 : g.ny() - 1;
        const Cell& c = cells_[g.index(cx, cy)];
        const std::size_t n = 2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(bed.stride()) +
                                   static_cast<std::size_t>(x));
        shear_[n] = c.friction_velocity * c.east / static_cast<float>(von_karman);
        shear_[n + 1] = c.friction_velocity * c.north / static_cast<float>(von_karman);
      }
  }

  const double fresh = p.snow ? p.snow->fresh_cohesion : 1;
  threshold_ = lifting_threshold(grain, p.air, p.cohesion * fresh);
  roughness_ = p.roughness > 0 ? p.roughness : grain_roughness(grain.diameter);
  if (!blows()) return;
  if (p.saltation_roughness)
    roughness_ = std::max(roughness_, 0.02 * strongest_ * strongest_ / (2 * p.air.gravity));
  const int levels =
      uniform() ? 1 : 2 + static_cast<int>(std::log(strongest_ / threshold_) / std::log1p(level_ratio));
  level_step_ = levels > 1 ? (strongest_ - threshold_) / (levels - 1) : 1;
  for (int n = 0; n < levels; ++n) {
    const double u = levels > 1 ? threshold_ + n * level_step_ : strongest_;
    const double shear = u / von_karman;
    const double up = 1.5 * p.lift_off.most_factor * u;
    const double height = up * up / (2 * p.air.gravity);
    const double fastest = shear * std::log(std::max(height / roughness_, 2.0));
    tables_.emplace_back(HopWind{u, roughness_, grain, p.air}, fastest, std::max(up, 0.4 * fastest));
    reach_.push_back(mean_reach(tables_.back()));
  }
  for (int n = 0; n < levels; ++n)
    most_launches_ =
        std::max(most_launches_, launches(tables_[static_cast<std::size_t>(n)].wind().friction_velocity));
  mean_flux_ = uniform() ? flux(strongest_) : 0;
  for (const Cell& c : cells_) mean_flux_ += flux(c.friction_velocity) / static_cast<double>(cells_.size());
}

/// Chains of hops over flat loose ground.
double Drift::mean_reach(const HopTable& table) const {
  const double u = table.wind().friction_velocity;
  const auto unit = static_cast<float>(std::sqrt(parameters_.air.gravity * grain_.diameter));
  const LiftOff& lift = parameters_.lift_off;
  RandomStream random(0x5eed, 0);
  double total = 0;
  for (int n = 0; n < followed; ++n) {
    const double up = u * (lift.least_factor + (lift.most_factor - lift.least_factor) * random.uniform());
    const double angle = lift.least_angle + (lift.most_angle - lift.least_angle) * random.uniform();
    Eigen::Vector3f v(static_cast<float>(up / std::tan(angle)), 0, static_cast<float>(up));
    for (int hop = 0; hop < most_hops; ++hop) {
      const Hop h = table.at(v.x(), v.z());
      total += h.range;
      const Eigen::Vector3f impact(static_cast<float>(h.along), 0, -static_cast<float>(h.down));
      const BounceResult b =
          bounced(parameters_.bounce, impact, 0, 0, unit, static_cast<float>(random.uniform()));
      if (b.captured) break;
      v = b.velocity;
    }
  }
  return total / followed;
}

std::size_t Drift::level(double u) const {
  if (tables_.size() < 2) return 0;
  const double place = std::round((u - threshold_) / level_step_);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(tables_.size() - 1)));
}

double Drift::flux(double u) const {
  const double mass = parameters_.snow ? saturated_snow_flux(u, threshold_, parameters_.air)
                                       : saturated_sand_flux(u, threshold_, parameters_.air);
  return mass / (grain_.density * (1 - grain_.porosity));
}

double Drift::reach(double u) const { return reach_[level(u)]; }

double Drift::launches(double u) const { return u > threshold_ ? flux(u) / (reach(u) * parcel_) : 0; }

const HopTable& Drift::hops(double u) const { return tables_[level(u)]; }

}  // namespace aeolian
