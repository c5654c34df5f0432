#pragma once

/// The room `saltation`: grains and wind in balance.
///
/// The steady state of saltation for one wind, after Werner (1987), ch. IV, with the splash of Kok & Renno
/// (2009): here as the three-number law (impact threshold, amplitude, correction) fitted to solved states.

#include "aeolian_core/saltation/saltation_state.hpp"
