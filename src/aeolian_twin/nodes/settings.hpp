#pragma once

#include "aeolian_core/twin/forecast_engine.hpp"
#include "aeolian_core/twin/forecast_scorer.hpp"
#include "aeolian_twin/nodes/parameters.hpp"
#include "aeolian_twin/nodes/tell.hpp"

/// What the parameters of a node say, for the node and for `replay`. Each is read in the node's own file.
namespace aeolian {

/// A table of saltation that cannot be used is told, and the law is used.
ForecastEngine::Settings read_engine(const Parameters& parameters, const Tell& tell);
ForecastScorer::Settings read_scorer(const Parameters& parameters);

}  // namespace aeolian
