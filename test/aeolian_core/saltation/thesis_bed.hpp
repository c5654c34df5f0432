#pragma once

#include "aeolian_core/saltation/distribution_kernel.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// The sand and air of Werner (1987), ch. IV (saltation specification, sec. 4).
inline SaltatingBed thesis_bed(double drag_scale = 1) {
  SaltatingBed bed;
  bed.grain.diameter = 0.00025;
  bed.grain.density = 2600;
  bed.atmosphere = {1.23, 1.46e-5, 9.81};
  bed.drag_law = DragLaw::sphere;
  bed.drag_scale = drag_scale;
  return bed;
}

inline DistributionKernel thesis_splash(int number) {
  return DistributionKernel(DistributionSplash::thesis_case(number));
}

}  // namespace aeolian
