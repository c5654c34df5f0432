#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "aeolian_core/grains/impacts/bed_packing.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// A grain that is fired at a bed.
struct Shot {
  double speed;           ///< [m/s]
  double angle;           ///< of its path below the horizontal [rad]
  double size_ratio = 1;  ///< its radius over the mean one of the bed
  double along = 0;       ///< where its path meets the mean height of the surface [m]
  double across = 0;      ///< the same across the flight, spheres only [m]
};

/// The first contact with a grain of the bed.
struct FirstContact {
  int target;           ///< the bed's grain
  Origin step;          ///< what that one is beside
  double normal_angle;  ///< of the contact's normal from the vertical, positive on the upstream side [rad]
  double approach;      ///< speed along the normal before [m/s]
  double departure;     ///< and after, away from the target [m/s]
  int struck;           ///< grains of the bed that the grain touches in all until it leaves
  /// With which the target answers, over the mass of a mean bed grain (Werner 1987, appendix III.1 solved for
  /// it); NaN where it means nothing: after a second contact.
  double effective_mass;
};

/// A grain that has risen by a diameter above the top of the bed.
///
/// Vectors are in the frame of Impact: x along the flight, y to the left, z up.
struct RisenGrain {
  int grain;                                           ///< its number in the bed
  double time;                                         ///< after the first contact [s]
  double radius;                                       ///< [m]
  double spin;                                         ///< size of it [rad/s]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< at that time, in the bed [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< at that time [m/s]
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< from the impact to its place in the bed at rest [m]
  int layer;  ///< of the bed that it came from; 0 for the incident grain
  Origin kind = Origin::other;
};

/// What one impact did.
struct ImpactOutcome {
  Shot shot;
  std::optional<FirstContact> contact;  ///< none: the grain has not met the bed, nothing else counts
  std::optional<RisenGrain> rebound;    ///< none: the bed has captured the grain
  std::vector<RisenGrain> ejecta;       ///< in the order in which they rose
  double incident_mass = 1;             ///< over that of a mean bed grain
  double steps = 0;                     ///< grains moved by steps: the work
  int number = 0;                       ///< of the impact in its series
};

/// When an impact is over, and who takes part in the steps.
struct ImpactRules {
  /// After the first contact, in sqrt(radius / g): 0.07 s for the thesis' grains of 1 cm.
  double follow = 2.19248;
  bool end_when_calm = true;  ///< once no grain has the energy to rise to where it is noted
  SleepRule sleep;            ///< of the grains that the impact does not reach
};

/// Sees the grains as an impact goes on, once a step; the time is that after the first contact, negative
/// before.
template <int Dim>
using ImpactWatch = std::function<void(const GrainDynamics<Dim>& grains, int incident, double time)>;

/// Fires one grain at a copy of a bed (Werner 1987, ch. III; splash specification, sec. 3.2): grains that
/// rise by more than a diameter above the bed's top are noted and taken away. Throws Error for a shot that is
/// not valid: speed, angle (1 to 90 degrees), size ratio (0.1 to 10).
template <int Dim>
ImpactOutcome fire(const Bed<Dim>& bed, const Shot& shot, const ImpactRules& rules,
                   const ImpactWatch<Dim>& watch = {});

/// The outcome as data for a SplashTable: velocities are those at the height of the bed's top, from where the
/// grains rose.
SplashEvent splash_event(const ImpactOutcome& outcome, double bed_radius);

extern template ImpactOutcome fire(const Bed<2>&, const Shot&, const ImpactRules&, const ImpactWatch<2>&);
extern template ImpactOutcome fire(const Bed<3>&, const Shot&, const ImpactRules&, const ImpactWatch<3>&);

}  // namespace aeolian
