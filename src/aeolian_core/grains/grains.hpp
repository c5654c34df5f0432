#pragma once

/// The room `grains`: what one grain is and what one impact does.
///
/// Grain properties; what one impact throws up, as a rebound model, as functions of the literature or as a
/// table of events, after Werner (1987), ch. II-III and later work; and the mean effect of impacts on the bed
/// (ejecta, reptation), as collected in the splash specification. docs/splash.md tells which to use when.

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/mean_splash.hpp"
#include "aeolian_core/grains/reptation.hpp"
#include "aeolian_core/grains/splash.hpp"
#include "aeolian_core/grains/splash_choice.hpp"
#include "aeolian_core/grains/splash_table.hpp"
#include "aeolian_core/grains/surface_roughness.hpp"
