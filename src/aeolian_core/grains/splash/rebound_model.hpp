#pragma once

#include "aeolian_core/grains/splash/splash.hpp"
#include "aeolian_core/grains/splash/two_body_rebound.hpp"

namespace aeolian {

/// Rebound from a row of equal discs or spheres: Werner's rebound model (1987, ch. III and app. III.1; splash
/// specification, secs. 2.9 and 3.5).
///
/// A straight ray at a random offset meets the first grain of the row, leaves after a two-body collision and
/// meets a second one, maybe; a third collision, or a way down, captures it. Gravity does nothing within a
/// grain's diameter. The rebound scales with the speed of the impact; its distribution is broad, skewed and
/// bounded. Angles to the bed, slopes and size ratios enter as they are. Published results are for 5 to 80
/// degrees and size ratios of 0.25 to 2.
class ReboundModel : public Rebound {
 public:
  struct Parameters {
    double restitution = 0.85;
    double friction_restitution = 0;  ///< sigma of TwoBodyRebound
    double inertia = 0.4;             ///< of the grain: 0.4 spheres, 0.5 discs
    double bed_inertia = 0.8;         ///< of the target; twice its own, as neighbours hinder its turning
    double gap = 0;                   ///< between the bed's grains, in their radii
    double spin = 0;                  ///< of the grain before, times its radius over its speed
    /// Effective mass of the target, in bed grains: `mass` + `mass_share` times that of the grain that hits.
    double mass = 2;
    double mass_share = 0;
    double mass_exponent = 3;  ///< of a grain's mass in its diameter: 3 spheres, 2 discs, 0 all equal
    int most_collisions = 2;   ///< 1 or 2
  };
  /// Discs of table 3.10 of the thesis: 1 is elastic in friction, 2 is the one that agrees with simulations.
  /// Throws Error for another number.
  static Parameters thesis_case(int number);

  /// Throws Error naming the parameter, its value and what is allowed.
  explicit ReboundModel(const Parameters& parameters);

  struct Bounce {
    Eigen::Vector2d velocity;  ///< along the bed and away from it, over the speed of the impact
    int collisions;
    bool captured;    ///< the velocity is then zero
    double upstream;  ///< of the first contact's normal: the sine of beta
  };
  /// What one ray does. `angle` to the bed, 0 to pi / 2 [rad]; `offset` 0 to 1 across what one grain of the
  /// bed takes of the rays.
  Bounce bounce(double angle, double size_ratio, double offset) const;

  struct Means {
    double along;          ///< eps_ix: horizontal speed after over before
    double upward;         ///< eps_iy
    double from_vertical;  ///< theta_i: direction of those that leave [rad]
    double contact_angle;  ///< [rad]
    double captured;       ///< share
    double twice;          ///< share that hits a second grain
  };
  /// Over so many rays, evenly spaced; captured grains count as at rest.
  Means means(const Impact& impact, int rays) const;

  std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const override;

 private:
  TwoBodyRebound collision(double size_ratio) const;

  Parameters parameters_;
  TwoBodyRebound equal_sizes_;
};

/// Mean contact angle of a close-packed row of discs as large as the impacting one [rad]; for angles to the
/// bed up to 30 degrees (splash specification, sec. 3.5).
double mean_contact_angle(double angle);

}  // namespace aeolian
