#pragma once

#include <string>
#include <vector>

#include "aeolian_core/grains/impacts/impact_statistics.hpp"

namespace aeolian {

/// A number of a study by its name in summary.csv, in SI units and degrees.
struct Quantity {
  std::string name;
  MeanValue value;
};

/// All numbers about one series of impacts.
std::vector<Quantity> quantities(const ImpactStatistics& statistics);

}  // namespace aeolian
