#pragma once

#include <optional>
#include <string>

#include "aeolian_core/saltation/mixture_solver.hpp"

namespace aeolian {

/// A mixture in the wind that was asked for.
struct MixtureRun {
  GrainMixture mixture;
  MixtureState state;
  std::optional<double> impact_threshold;  ///< [m/s]
  std::string no_threshold;                ///< why there is none
};

/// Writes mixture.csv (what each size does) and mixture.yaml (what all do together) into a folder.
void write_mixture(const MixtureRun& run, const std::string& folder);

}  // namespace aeolian
