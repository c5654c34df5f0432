#pragma once

/// The room `measure`: from what instruments see to heights, and back.
///
/// Point clouds are fused into a height map with its variance; a height map yields its ripple statistics. A
/// photograph of a straightedge's shadow yields a cross-section of the bed: `setup_geometry` (camera and
/// scale) -> `shadow_search` (roughly) -> `shadow_terminus` (to a fraction of a pixel) -> `photo_light` ->
/// `shadow_profile`, and `profile_analysis` its ripples. The forward models of the instruments (scanner,
/// camera over a straightedge's shadow, anemometer) stand beside: a virtual field day is made with them. The
/// shadow geometry follows Werner (1987), ch. V.
///
/// The ripples of a map one by one: `ripple_pattern` (how long, which way) -> `ripple_relief` (rows square to
/// the crests, without bed and noise) -> `crest_rows` -> `crest_links` -> `ripple_crests` (lines and their
/// ends)
/// -> `ripple_shapes` (figures of the map); over time `ripple_tracking`.
///
/// A cloud whose pose is somewhat wrong is laid onto the map by `registration` (against `map_surface`, by
/// `point_to_plane`); `bed_frame` finds the frame whose z is the bed's normal.
///
/// The way of a point into the map: `point_locator` (place and noise: `sensor_noise`), `sample_buckets` (by
/// tile), `fusion_tile` (does it agree with its cell? else `lower_surface`), `tile_filter` (two Kalman
/// filters a cell, under `height_change`). `fixed_point` says why the result does not depend on order or
/// threads.

#include "aeolian_core/measure/bed_frame.hpp"
#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/measure/photo.hpp"
#include "aeolian_core/measure/photo_setup.hpp"
#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/measure/virtual_anemometer.hpp"
#include "aeolian_core/measure/virtual_camera.hpp"
#include "aeolian_core/measure/virtual_scanner.hpp"
