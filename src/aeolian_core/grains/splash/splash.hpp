#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// One grain that hits the bed.
///
/// Velocities of impacts and splashes are in the frame of the grain's flight: x horizontal in the direction
/// in which it came, y across to the left of it, z up. `slope` tells the bed under it.
struct Impact {
  double speed;           ///< [m/s]
  double angle;           ///< of its path below the horizontal, 0 to pi / 2 [rad]
  double slope = 0;       ///< of the bed in the direction of flight, positive where it rises [rad]
  double size_ratio = 1;  ///< the grain's diameter over that of the bed's grains
  double roughness = 0;   ///< brinks per diameter of the bed's grains along the flight

  double angle_to_bed() const { return angle + slope; }  ///< [rad]
};

/// Throws Error naming the property, its value and what is allowed: a speed that is positive and finite, an
/// angle to the bed between 0 and pi, a slope steeper than neither way up, a positive size ratio.
void check(const Impact& impact);

/// Where a grain that leaves the bed came from (Werner 1987, ch. III).
enum class Origin {
  rebound,     ///< it is the grain that hit
  target,      ///< the grain that was hit
  brink,       ///< beside a step that falls in the direction of flight
  anti_brink,  ///< beside a step that rises in it
  other,
};
/// As files have it: "anti_brink".
const char* name_of(Origin origin);
/// Of the bed's own grains.
inline constexpr Origin ejecta_origins[] = {Origin::target, Origin::brink, Origin::anti_brink, Origin::other};

/// A grain that leaves the bed.
struct LeavingGrain {
  Eigen::Vector3d velocity;  ///< frame of Impact [m/s]
  double size_ratio = 1;     ///< its diameter over that of the bed's grains
  double distance = 0;       ///< of its place from the impact, along the flight [m]
  Origin origin = Origin::other;
};

/// What one impact throws up.
struct SplashEvent {
  std::optional<LeavingGrain> rebound;  ///< none: the bed has captured the grain
  std::vector<LeavingGrain> ejecta;
};

/// What becomes of the grain that hits.
class Rebound {
 public:
  virtual ~Rebound() = default;
  /// None: the bed has captured it.
  virtual std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const = 0;
};

/// What an impact throws out of the bed.
class Ejection {
 public:
  virtual ~Ejection() = default;
  /// Mean number of grains for one impact.
  virtual double mean_number(const Impact& impact) const = 0;
  /// Appends the grains of one impact.
  virtual void sample(const Impact& impact, RandomStream& random,
                      std::vector<LeavingGrain>& ejecta) const = 0;
};

/// The bed's answer to impacts, one at a time: individual velocities; who saltates and who reptates is for
/// the wind to say (Werner 1987, ch. IV: the splash function S(v_out; v_in)).
class Splash {
 public:
  virtual ~Splash() = default;
  /// Never more kinetic energy, nor more momentum along the path of the impact, than the impact brought.
  /// Throws Error for an impact that check() refuses. `event` is overwritten; using one event again and again
  /// saves its memory from being asked for each time.
  void sample(const Impact& impact, RandomStream& random, SplashEvent& event) const {
    check(impact);
    draw(impact, random, event);
  }
  SplashEvent sample(const Impact& impact, RandomStream& random) const {
    SplashEvent event;
    sample(impact, random, event);
    return event;
  }
  /// Mean number of grains that one impact ejects, before what energy and momentum forbid is left out.
  virtual double mean_ejecta(const Impact& impact) const = 0;

 private:
  /// `impact` is valid; what `event` holds is of no use.
  virtual void draw(const Impact& impact, RandomStream& random, SplashEvent& event) const = 0;
};

/// Mass of leaving grains and of the impacting one in terms of a bed grain's, and what they carry.
/// @{
double kinetic_energy(const SplashEvent& event);  ///< over the mass of a bed grain [m^2/s^2]
double kinetic_energy(const Impact& impact);      ///< over the mass of a bed grain [m^2/s^2]
/// @}

/// Their momentum along the path of the impact, over the mass of a bed grain [m/s].
/// @{
double momentum_along(const Impact& impact, const SplashEvent& event);
double momentum(const Impact& impact);
/// @}

/// Sum of the ballistic hops of an event's ejecta on a bed that rises by `slope` [rad] in the direction of
/// flight, horizontal, backward ones negative [m] (splash specification, sec. 3.7).
double reptation_distance(const SplashEvent& event, double slope);

}  // namespace aeolian
