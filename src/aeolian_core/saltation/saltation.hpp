#pragma once

/// The room `saltation`: grains and wind in balance.
///
/// The steady state of saltation for one wind, after Werner (1987), ch. IV: the conveyor-belt models, the
/// wind slowed by the grains in it (WindProfile), their flights (Flight), splash functions as linear kernels
/// (SplashKernel), and the state in which each grain that lands is replaced by one that leaves
/// (SaltationSolver). What beds need of it is a SaltationState: from the three-number law, or from a
/// SaltationTable of solved states. Gusts, thresholds and fetch stand beside it.

#include "aeolian_core/saltation/conveyor.hpp"
#include "aeolian_core/saltation/delta_kernel.hpp"
#include "aeolian_core/saltation/distribution_kernel.hpp"
#include "aeolian_core/saltation/flux_response.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/literal_iteration.hpp"
#include "aeolian_core/saltation/mixture_solver.hpp"
#include "aeolian_core/saltation/profiles.hpp"
#include "aeolian_core/saltation/saltation_source.hpp"
#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"
#include "aeolian_core/saltation/steady_state.hpp"
#include "aeolian_core/saltation/supplied_state.hpp"
#include "aeolian_core/saltation/thresholds.hpp"
#include "aeolian_core/saltation/transient_saltation.hpp"
