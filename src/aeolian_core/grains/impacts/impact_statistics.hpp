#pragma once

#include <map>
#include <vector>

#include "aeolian_core/grains/impacts/impact.hpp"

namespace aeolian {

/// A mean, the standard deviation of the values, and the standard error of the mean; NaN where there are too
/// few.
struct MeanValue {
  double mean;
  double half_width;
  double error;
  int count;
};

/// Of values that are independent.
MeanValue mean_value(const std::vector<double>& values);
/// Of all values in groups that are independent of each other, while those within a group may not be: the
/// ejecta of impacts. The error is that of a ratio of sums over groups.
MeanValue pooled_mean(const std::vector<std::vector<double>>& groups);

/// What ejecta of one kind carry away, an impact.
struct EjectaShare {
  MeanValue number;
  MeanValue angle;      ///< from the vertical, positive along the flight, mean over grains [rad]
  MeanValue momentum;   ///< along the flight, over that of the incident grain
  MeanValue reptation;  ///< sum of ballistic hops [m]
};

/// What a series of impacts did (splash specification, sec. 3.3; Werner 1987, tables 3.2 to 3.9). Impacts
/// that missed the bed do not count.
struct ImpactStatistics {
  int impacts = 0;
  int captured = 0;  ///< of those, without a rebound
  int backward = 0;  ///< rebounds against the flight

  // Rebounds: out over in, along the flight, up, and of the speed.
  MeanValue along, up, speed;
  MeanValue rebound_angle;  ///< from the vertical, positive along the flight [rad]
  MeanValue rolling;        ///< spin times radius over the speed along the flight; 1 rolls
  MeanValue normal_angle;   ///< of the first contact's normal, positive on the upstream side [rad]

  // What the bed gets from impacts with a rebound, over the momentum of the incident grain.
  MeanValue bed_along, bed_down;
  MeanValue bed_angle;       ///< of that momentum, below the horizontal [rad]
  MeanValue effective_mass;  ///< of the target, over a mean bed grain's
  double effective_mass_median = 0;
  MeanValue bed_energy;  ///< energy that no leaving grain takes, over the incident, of all impacts

  // Ejecta: means over grains.
  MeanValue ejecta_speed, ejecta_upward;               ///< [m/s]
  MeanValue ejecta_angle;                              ///< from the vertical, positive along the flight [rad]
  MeanValue origin_along, origin_up, origin_distance;  ///< from the point of impact [m]
  double from_upper_layers = 0;                        ///< share of those from the first two layers

  // Ejecta: means over impacts.
  MeanValue number;
  MeanValue reptation;                      ///< sum of ballistic hops [m]
  MeanValue ejected_along, ejected_up;      ///< momentum over the incident grain's size of momentum
  MeanValue ejected_energy;                 ///< over the incident grain's
  std::map<Origin, EjectaShare> by_origin;  ///< target, brink, anti_brink and other
};

/// Along the flight, of a grain that lands as high as it rose, without drag: 2 v_x v_z / g [m].
inline double ballistic_hop(const Eigen::Vector3d& velocity) {
  return 2 * velocity.x() * velocity.z() / gravity;
}

/// Momentum and energy in terms of a mean bed grain's mass, so that size ratios count.
template <int Dim>
ImpactStatistics impact_statistics(const std::vector<ImpactOutcome>& outcomes, const Bed<Dim>& bed);

extern template ImpactStatistics impact_statistics(const std::vector<ImpactOutcome>&, const Bed<2>&);
extern template ImpactStatistics impact_statistics(const std::vector<ImpactOutcome>&, const Bed<3>&);

}  // namespace aeolian
