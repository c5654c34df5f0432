#pragma once

/// The room `wind`: the wind over the surface.
///
/// An anemometer's reading becomes the friction velocity that the grains feel. On flat ground that is the law
/// of the wall (Werner 1987, eq. 4.28: u = (u*/kappa) ln(z/z0) with z0 = d/30). Over relief `TerrainWind`
/// takes linear theory where it is gentle (Jackson & Hunt 1975; Weng et al. 1991; separated air as Kroy et
/// al. 2002) and a mass-consistent wind where it is steep (Sherman 1978), the air of particles of `sph/`
/// (after Dobusch 2016) when it is asked to, and `WindProbe` tells velocity,
/// lift and gusts (Kaimal et al. 1972) at points of the air.

#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/gusts.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_core/wind/terrain_wind.hpp"
#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_core/wind/wind_probe.hpp"
#include "aeolian_core/wind/wind_record.hpp"
