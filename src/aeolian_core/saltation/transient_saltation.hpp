#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// Grains that the wind alone sets moving, c (tau_s - tau_ft) per area and time, with enough speed to rise by
/// their diameter (Anderson & Haff 1988).
struct Entrainment {
  double coefficient = 1e5;  ///< c [N^-1 s^-1]; zero: none
  double threshold = 0;      ///< u*_ft [m/s]; zero: of the bed, SaltatingBed::fluid_threshold
};

/// Saltation in a wind that changes (Werner 1987, eq. 4.35): grains land a time of flight after they were
/// launched and throw up others in the wind of that moment. The wind is in balance with the grains in the air
/// at every step; flights are those of the wind at the time.
class TransientSaltation {
 public:
  /// No grains in the air. `step` [s] should be well below the time of a flight. Throws Error for a step that
  /// is not positive and a bed that is not physical.
  TransientSaltation(const SaltatingBed& bed, const SplashKernel& splash, const Entrainment& entrainment = {},
                     double step = 0.005);

  /// Puts the grains of a steady state of the same bed and splash into the air, as if it had lasted.
  void begin(const SteadyState& state);
  /// Lets this wind blow for `duration` [s], in whole steps. Throws Error for friction velocities that are
  /// negative, not finite or above 10 m/s.
  void advance(double duration, double friction_velocity);

  double time() const { return time_; }                ///< [s]
  double mass_flux() const { return mass_flux_; }      ///< [kg m^-1 s^-1]
  double impact_rate() const { return impact_rate_; }  ///< [m^-2 s^-1]
  double surface_friction_velocity() const { return surface_; }

 private:
  void set_classes();
  void step(double friction_velocity);
  double launched(std::size_t k, double ago) const;

  SaltatingBed bed_;
  std::unique_ptr<SplashKernel> splash_;
  Drag drag_;
  double entrained_;        ///< [N^-1 s^-1]
  double fluid_threshold_;  ///< [m/s]
  double step_;
  WindProfile wind_;
  std::vector<double> share_, stress_, spectrum_;
  Launches launches_;
  Landings landings_;
  std::size_t entrained_class_ = 0;
  std::deque<std::vector<double>> history_;  ///< launched in all, of each class, newest first [m^-2]
  std::vector<double> landed_;               ///< in all [m^-2]
  double time_ = 0, mass_flux_ = 0, impact_rate_ = 0, surface_ = 0;
};

}  // namespace aeolian
