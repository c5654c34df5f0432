#pragma once

#include <vector>

#include "aeolian_twin/nodes/settings.hpp"

namespace aeolian {

/// The parameters of a forecaster that its engine takes; read_engine() reads them.
std::vector<ParameterDeclaration> engine_parameters();

/// Roughness length of the forecaster's bed [m].
double bed_roughness(const Parameters& parameters);

/// What an engine has from files before the first map: parameters learned earlier, where `~learned_file`
/// exists, and the wind of `~wind_ahead_file`. Throws Error naming file and value for one that cannot be
/// used.
void prepare_engine(const Parameters& parameters, ForecastEngine& engine, const Tell& tell);

}  // namespace aeolian
