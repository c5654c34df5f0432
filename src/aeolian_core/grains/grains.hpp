#pragma once

/// The room `grains`: what one grain is and what one impact does.
///
/// The dynamics of soft grains that touch, roll and fly (Werner 1987, ch. II; docs/accuracy/grains.md), grain
/// properties, and the mean effect of an impact on the bed (ejecta, reptation) after Werner (1987), ch.
/// II-III and Kok & Renno (2009), as collected in the splash specification.

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/grain_dynamics.hpp"
#include "aeolian_core/grains/mean_splash.hpp"
