#pragma once

#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// The iteration as Werner (1987, sec. 4.2) describes it: the number of grains is part of the unknown
/// spectrum, and spectrum and wind go on by a part of each step (saltation specification, sec. 3.1 and 3.2:
/// without such a part, min(0.3, 3 (u*_eff / u*)^2), it swings). Only for comparison: SaltationSolver finds
/// the same state in a tenth of the steps. Ends when no part of the spectrum above 1e-3 of its largest and no
/// wind changes by more than `tolerance`, as the thesis did with one per cent; outcome `none` where that
/// takes more than `most_iterations`.
SteadyState literal_iteration(const SaltatingBed& bed, const SplashKernel& splash, double friction_velocity,
                              double tolerance = 0.01, int most_iterations = 5000);

}  // namespace aeolian
