#pragma once

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/grains/mean_splash.hpp"
#include "aeolian_core/saltation/saltation_source.hpp"
#include "aeolian_core/twin/uncertain_parameters.hpp"
#include "aeolian_core/twin/wind_course.hpp"

namespace aeolian {

/// The physics that all members of an ensemble share.
struct TwinPhysics {
  Grain grain;
  SaltationSource saltation;
  MeanSplash splash;
  RippleParameters ripple;
};

/// The mean forcing over a spell of wind, with parameters other than those given. Friction velocities that
/// are scaled beyond what the wind's limit allows stay physical; angles are kept within what models take.
/// Throws Error as SaltationSource::state does.
Forcing forcing_of(const TwinPhysics& physics, const WindSpell& spell, const UncertainParameters& parameters);

/// The ripple model's, with parameters other than those given.
RippleParameters ripple_parameters(const TwinPhysics& physics, const UncertainParameters& parameters);

}  // namespace aeolian
