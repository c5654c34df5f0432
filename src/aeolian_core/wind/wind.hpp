#pragma once

/// The room `wind`: the wind over the surface.
///
/// An anemometer's reading becomes the friction velocity that the grains feel. On flat ground that is the law
/// of the wall (Werner 1987, eq. 4.28: u = (u*/kappa) ln(z/z0) with z0 = d/30); models for relief join behind
/// the same `WindModel`.

#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_core/wind/wind_record.hpp"
