#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include "aeolian_twin/nodes/drawn_cells.hpp"

namespace aeolian {

/// The crests of a map's ripples as lines just above its mesh, the pattern taken as within 60 degrees of
/// `direction` [rad]; what takes such lines away when there are none.
visualization_msgs::Marker draw_crests(const DrawnLayers& layers, const SurfaceLook& look, double direction,
                                       const std_msgs::Header& header);

}  // namespace aeolian
