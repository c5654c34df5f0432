#pragma once

#include <functional>
#include <string>
#include <vector>

#include <aeolian_msgs/Comparison.h>
#include <grid_map_msgs/GridMap.h>

#include "aeolian_core/twin/forecast_scorer.hpp"
#include "aeolian_twin/nodes/relative_clock.hpp"
#include "aeolian_twin/nodes/tell.hpp"

namespace aeolian {

/// Where scores go.
struct ScoreOutput {
  std::string frame;           ///< of the maps
  const RelativeClock& clock;  ///< of the scorer's times
  std::function<void(aeolian_msgs::Comparison)> comparison;
  std::function<void(grid_map_msgs::GridMap)> difference;
  Tell tell;
};

/// Puts out each score as its two messages; one that was refused is told. The scorer gets the memory of the
/// differences back.
void put_out(std::vector<ForecastScorer::Score> scores, ForecastScorer& scorer, const ScoreOutput& out);

}  // namespace aeolian
