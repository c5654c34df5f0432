#pragma once

/// The room `surface`: what a surface is in this program.
///
/// Height maps on a regular grid, the tiles of them that are active, point clouds, and the files that hold
/// either. It is the lowest room: it knows neither physics nor sensors. It also keeps the few things that
/// every room needs: the error type, counter-based random numbers and files that appear whole or not at all.

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/grid_geometry.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/held_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_core/surface/preview.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/surface/submap.hpp"
#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_core/surface/unseen_changes.hpp"
