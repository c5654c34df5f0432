#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"

#include <cmath>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"erosion"};

void check(const LiftOff& lift) {
  require(lift.least_factor > 0 && lift.least_factor <= 10, "least lift-off factor", lift.least_factor,
          "above 0 to 10");
  require(lift.most_factor >= lift.least_factor && lift.most_factor <= 10, "most lift-off factor",
          lift.most_factor, "from the least to 10");
  require(lift.least_angle >= 0.02 && lift.least_angle < 1.57, "least lift-off angle", lift.least_angle,
          "0.02 to 1.57 rad");
  require(lift.most_angle >= lift.least_angle && lift.most_angle < 1.57, "most lift-off angle",
          lift.most_angle, "from the least to 1.57 rad");
  require(lift.lateral_spread >= 0 && lift.lateral_spread <= 1, "lateral spread", lift.lateral_spread,
          "0 to 1 rad");
}

void check(const Bounce& bounce) {
  require(bounce.normal_kept >= 0 && bounce.normal_kept <= 1, "normal part kept", bounce.normal_kept,
          "0 to 1");
  require(bounce.tangential_kept >= 0 && bounce.tangential_kept < 1, "tangential part kept",
          bounce.tangential_kept, "0 to below 1");
  require(bounce.capture_speed >= 0.01 && bounce.capture_speed <= 10, "capture speed", bounce.capture_speed,
          "0.01 to 10 m/s");
  require(bounce.rebound_share >= 0 && bounce.rebound_share <= 0.99, "rebound share", bounce.rebound_share,
          "0 to 0.99");
  require(bounce.rebound_speed >= 0.01 && bounce.rebound_speed <= 100, "rebound speed", bounce.rebound_speed,
          "0.01 to 100 m/s");
}

void check(const SnowBonding& snow) {
  require(snow.temperature >= -90 && snow.temperature <= 50, "temperature", snow.temperature,
          "-90 to 50 deg C");
  require(snow.bonding_time >= 1 && snow.bonding_time <= 1e9, "bonding time", snow.bonding_time,
          "1 to 1e9 s");
  require(snow.reference >= -90 && snow.reference < 0, "reference temperature", snow.reference,
          "-90 to below 0 deg C");
  require(snow.activation_energy >= 0 && snow.activation_energy <= 1e6, "activation energy",
          snow.activation_energy, "0 to 1e6 J/mol");
  require(snow.exponent > 0 && snow.exponent <= 10, "bonding exponent", snow.exponent, "above 0 to 10");
  require(snow.fresh_cohesion >= 0 && snow.fresh_cohesion <= 1e3, "cohesion of fresh snow",
          snow.fresh_cohesion, "0 to 1000");
  require(snow.bonded_cohesion >= snow.fresh_cohesion && snow.bonded_cohesion <= 1e4,
          "cohesion of bonded snow", snow.bonded_cohesion, "from that of fresh snow to 10000");
  require(snow.skin >= 1 && snow.skin <= 1e6, "skin", snow.skin, "1 to 1e6 parcels");
  require(snow.edge >= 0 && snow.edge <= 1e6, "edge", snow.edge, "0 to 1e6 parcels");
  require(snow.sintered_share >= 0 && snow.sintered_share <= 1, "sintered share", snow.sintered_share,
          "0 to 1");
  require(snow.initial_age >= 0 && snow.initial_age <= 1e9, "initial age", snow.initial_age, "0 to 1e9 s");
  require(snow.snowfall >= 0 && snow.snowfall <= 1, "snowfall", snow.snowfall, "0 to 1 kg/m^2/s");
}

}  // namespace

void check(const ErosionParameters& p) {
  check(p.air);
  check(p.lift_off);
  check(p.bounce);
  if (p.snow) check(*p.snow);
  require(p.inflow >= 0 && p.inflow <= 10, "inflow", p.inflow, "0 to 10");
  require(p.shelter_angle >= 0.02 && p.shelter_angle <= 1, "shelter angle", p.shelter_angle, "0.02 to 1 rad");
  require(p.impact_threshold > 0 && p.impact_threshold <= 1, "impact threshold", p.impact_threshold,
          "above 0 to 1");
  require(p.cohesion >= 0 && p.cohesion <= 1, "cohesion", p.cohesion, "0 to 1 kg/s^2");
  require(p.roughness >= 0 && p.roughness <= 0.1, "roughness", p.roughness, "0 to 0.1 m");
  require(p.parcel_thickness >= 0 && p.parcel_thickness <= 0.1, "parcel thickness", p.parcel_thickness,
          "0 to 0.1 m");
  require(p.acceleration >= 1e-3 && p.acceleration <= 1e5, "acceleration", p.acceleration, "0.001 to 1e5");
  require(p.step >= 1e-6 && p.step <= 1, "step", p.step, "1e-6 to 1 s");
  require(p.slide_every >= 1, "steps between avalanches", p.slide_every, "1 or more");
  require(p.slide_sweeps >= 1, "sweeps of avalanches", p.slide_sweeps, "1 or more");
  if (p.pool) {
    require(p.pool->parcels_per_cell > 0 && p.pool->parcels_per_cell <= 100, "parcels per cell",
            p.pool->parcels_per_cell, "above 0 to 100");
    require(p.pool->chance > 0 && p.pool->chance <= 1, "chance to leave", p.pool->chance, "above 0 to 1");
  }
}

ErosionParameters thesis_erosion() {
  ErosionParameters p;
  p.shelter = Shelter::slope;
  p.slope_threshold = false;
  p.impact_threshold = 1;
  p.spread = false;
  p.lift_off.lateral_spread = 0;
  p.pool = ErosionParameters::Pool{};
  return p;
}

}  // namespace aeolian
