#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_twin/nodes/drawn_cells.hpp"

namespace aeolian {

/// The wind at the ground of a map, just above its mesh: arrows as long as the friction velocity is great
/// (the greatest nearly meet), and streamlines of the surface stress, which end where it is not known and
/// where the air separates.
visualization_msgs::MarkerArray draw_wind(const WindField& wind, const DrawnLayers& layers,
                                          const SurfaceLook& look, const std_msgs::Header& header);

}  // namespace aeolian
