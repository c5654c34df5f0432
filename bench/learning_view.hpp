#pragma once

#include <cstdint>
#include <vector>

#include "learning_day.hpp"

namespace aeolian {

/// How a day is seen.
enum class View {
  noisy,    ///< 0.2 mm of noise in each cell, independent
  scanned,  ///< two virtual scanners on tripods, every ten seconds, fused to a live map
};

/// What is measured of a day's surface every minute until `until` [s]: layers elevation and variance.
/// Scanners are those of config/field_day.yaml, with the rays that meet this smaller plot.
std::vector<HeightMap> measured_maps(const LearningDay& day, View view, std::uint64_t seed, double until);

}  // namespace aeolian
