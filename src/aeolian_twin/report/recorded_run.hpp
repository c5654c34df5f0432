#pragma once

#include <string>

#include "aeolian_core/twin/report.hpp"

namespace aeolian {

/// What a report shows of a run of the twin, from the bag that holds what the nodes or `replay` gave:
/// /height_map, /forecast, /comparison and /wind_field. `truth_directory` is what simulate_field wrote, or
/// empty. Throws Error naming bag and topic.
Run read_recorded_run(const std::string& bag, const std::string& truth_directory = "");

}  // namespace aeolian
