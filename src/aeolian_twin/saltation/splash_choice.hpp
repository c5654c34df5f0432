#pragma once

#include <memory>
#include <string>

#include "aeolian_core/saltation/splash_kernel.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// What --splash says, as a splash for this bed: `werner` (eq. 4.34, case `thesis_case` of the thesis),
/// `ungar_haff`, `kok_renno`, `coarse_sand` or `table:FILE`. Throws Error naming the flag and its value for
/// anything else, and what reading the file throws.
std::unique_ptr<SplashKernel> splash_choice(const std::string& value, const SaltatingBed& bed,
                                            int thesis_case);

/// Of ground that gives no grains of its own.
std::unique_ptr<SplashKernel> hard_ground_choice(const SaltatingBed& bed);

}  // namespace aeolian
