#include "aeolian_twin/nodes/frame_check.hpp"

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

void require_frame(const std::string& topic, const std_msgs::Header& header, const Parameters& parameters) {
  const std::string& frame = parameters.text("frame_id");
  if (header.frame_id != frame)
    throw Error(fmt::format("{}: frame is '{}', must be '{}' (~frame_id)", topic, header.frame_id, frame));
}

}  // namespace aeolian
