#pragma once

/// The room `grains`: what one grain is and what one impact does.
///
/// After Werner (1987), ch. II-III, and later work, as collected in the splash specification:
/// - `dynamics`: soft grains that touch, roll and fly (docs/accuracy/grains.md);
/// - `impacts`: beds of such grains and series of impacts on them (docs/splash_study.md);
/// - `splash`: what one impact throws up, as a rebound model, as functions of the literature or as a table of
///   events (docs/splash.md tells which to use when);
/// and, in the room itself, the grain and the mean effect of impacts on the bed.

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/impacts/impact_statistics.hpp"
#include "aeolian_core/grains/impacts/impact_study.hpp"
#include "aeolian_core/grains/mean_splash.hpp"
#include "aeolian_core/grains/splash/reptation.hpp"
#include "aeolian_core/grains/splash/splash.hpp"
#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/grains/splash/surface_roughness.hpp"
