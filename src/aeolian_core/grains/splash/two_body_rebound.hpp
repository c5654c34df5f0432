#pragma once

#include <Eigen/Core>

namespace aeolian {

/// What two round bodies do when they meet: one that flies and spins, one at rest (Werner 1987, app. III.1,
/// eq. 3.A.1 with the sign of c1 corrected; splash specification, sec. 2.9).
class TwoBodyRebound {
 public:
  struct Parameters {
    double mass_ratio = 0.5;          ///< of the flying body over the effective mass of the one at rest
    double restitution = 0.85;        ///< normal, 0 to 1
    double friction_restitution = 0;  ///< sigma: surface speed after over before; 1 frictionless, 0 rolling
    double inertia = 0.5;             ///< kappa of the flying body: moment of inertia / (m r^2)
    double target_inertia = 1;        ///< kappa of the one at rest
  };
  explicit TwoBodyRebound(const Parameters& p)
      : inertia_(p.inertia),
        c1_(1 / p.inertia + p.mass_ratio * (1 + 1 / p.target_inertia)),
        keep_((p.friction_restitution + c1_) / (1 + c1_)),
        turn_((1 - p.friction_restitution) / (1 + c1_)),
        bounce_((p.restitution - p.mass_ratio) / (1 + p.mass_ratio)) {}

  double c2() const { return keep_; }
  double c3() const { return turn_; }
  double c4() const { return bounce_; }

  /// `normal`: unit length, from the resting body to the flying one. `surface_spin`: the flying body's spin
  /// times its radius, counter-clockwise [m/s]; brought up to date.
  Eigen::Vector2d velocity_after(const Eigen::Vector2d& velocity, const Eigen::Vector2d& normal,
                                 double& surface_spin) const {
    const Eigen::Vector2d tangent(normal.y(), -normal.x());
    const double before = velocity.dot(tangent);
    const double after = keep_ * before - turn_ * surface_spin;
    surface_spin += (after - before) / inertia_;
    return after * tangent - bounce_ * velocity.dot(normal) * normal;
  }

 private:
  double inertia_, c1_, keep_, turn_, bounce_;
};

}  // namespace aeolian
