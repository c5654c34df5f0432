#pragma once

#include "aeolian_core/twin/forecast_scorer.hpp"
#include "aeolian_twin/nodes/parameters.hpp"

/// What the parameters of a node say, for the node and for `replay`. Each is read in the node's own file.
namespace aeolian {

ForecastScorer::Settings read_scorer(const Parameters& parameters);

}  // namespace aeolian
