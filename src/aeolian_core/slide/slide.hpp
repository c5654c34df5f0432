#pragma once

/// The room `slide`: snow that slides off a panel and piles up, after Frischholz (see the specification).
///
/// `mpm/` is the material point method for cohesive snow among obstacles, `piles/` what happens at a panel,
/// event by event, and how a pile is measured. `calibration/` finds the snow that builds measured piles, and
/// `surrogate/` learns from many piles to tell the next at once.

#include "aeolian_core/slide/calibration/snow_calibration.hpp"
#include "aeolian_core/slide/mpm/material_points.hpp"
#include "aeolian_core/slide/piles/pile_measure.hpp"
#include "aeolian_core/slide/piles/site_piles.hpp"
#include "aeolian_core/slide/piles/slide_series.hpp"
#include "aeolian_core/slide/surrogate/pile_design.hpp"
#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"
