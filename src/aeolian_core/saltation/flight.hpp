#pragma once

#include <cstddef>
#include <vector>

#include "aeolian_core/saltation/drag.hpp"
#include "aeolian_core/saltation/wind_profile.hpp"

namespace aeolian {

/// Grains that leave the bed, sorted into classes.
struct Launches {
  std::vector<double> vx;      ///< with the wind [m/s]
  std::vector<double> vy;      ///< upwards, positive [m/s]
  std::vector<double> number;  ///< of each class, in any measure

  std::size_t size() const { return vy.size(); }
  void resize(std::size_t classes);
};

/// What becomes of one grain of each class when it has come back to the bed.
struct Landings {
  std::vector<double> vx;        ///< [m/s]
  std::vector<double> vy;        ///< downwards, positive [m/s]
  std::vector<double> duration;  ///< of the flight [s]
  std::vector<double> length;    ///< of the hop [m]
  std::vector<double> apex;      ///< highest point over the place of launch [m]

  void resize(std::size_t classes);
};

/// One step of a flight; accelerations are those at its ends.
struct FlightStep {
  double duration;
  double x0, y0, vx0, vy0, ax0, ay0;
  double x1, y1, vx1, vy1, ax1, ay1;
};

/// What to fly in. Gravity and drag only: no lift, no spin, no turbulence, no collisions.
struct FlightConditions {
  const WindProfile& wind;
  const Drag& drag;
  double gravity = 9.81;    ///< [m/s^2]
  double tolerance = 1e-4;  ///< of a step's velocity, over the launch's or 20 sqrt(g l) if that is more
};

/// Flies classes whose number is above `least` from the bed at the wind's roughness length until they are
/// back there; the landings of others are left as they are. Adds to stress[i] the momentum that passes
/// upwards through level i of the wind, over the mass of one grain: the sum of number x (vx on the way down -
/// vx on the way up). stress[0] is the momentum that the grains have taken from the wind, exactly.
///
/// Steps are controlled by the error of Bogacki & Shampine's pair of orders 3 and 2; eight flights are
/// computed abreast. Throws Error for a flight that does not end within a hundred thousand steps.
void fly(const Launches& launches, double least, const FlightConditions& conditions, Landings& landings,
         std::vector<double>& stress);

/// The same for a single grain, with all its steps.
std::vector<FlightStep> trace(double vx, double vy, const FlightConditions& conditions);

}  // namespace aeolian
