#pragma once

#include "aeolian_core/grains/dynamics/contact_law.hpp"

namespace aeolian {

/// What the length of a step depends on.
struct StepInputs {
  double least_mass = 0;    ///< of a grain [kg]; zero: there is none
  double least_radius = 0;  ///< [m]
  double speed = 0;         ///< the largest, walls included [m/s]
  double acceleration = 0;  ///< the largest [m/s^2]
  double overlap = 0;       ///< the largest [m]
  double gravity = 0;       ///< [m/s^2]
};

/// The shortest contact over `steps_per_contact`, shortened where a grain would move more than a tenth of the
/// smallest radius or where damping or drag would overshoot [s].
double time_step(const ContactLaw& law, double steps_per_contact, double drag, const StepInputs& inputs);

}  // namespace aeolian
