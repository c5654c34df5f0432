#pragma once

/// The room `measure`: from what instruments see to heights, and back.
///
/// Point clouds are fused into a height map with its variance; a height map yields its ripple statistics. The
/// forward models of the instruments (scanner, camera over a straightedge's shadow, anemometer) stand beside:
/// a virtual field day is made with them. The shadow geometry follows Werner (1987), ch. V; `fusion` is a
/// scalar Kalman filter per cell.

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/measure/virtual_anemometer.hpp"
#include "aeolian_core/measure/virtual_camera.hpp"
#include "aeolian_core/measure/virtual_scanner.hpp"
