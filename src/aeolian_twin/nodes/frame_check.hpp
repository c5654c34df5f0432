#pragma once

#include <string>

#include <std_msgs/Header.h>

#include "aeolian_twin/nodes/parameters.hpp"

namespace aeolian {

/// Throws Error for a header of a message on `topic` whose frame is not the node's `~frame_id`.
void require_frame(const std::string& topic, const std_msgs::Header& header, const Parameters& parameters);

}  // namespace aeolian
