#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// How one elevation differs from another over the cells known in both. NaN when there is none.
struct DifferenceStatistics {
  std::size_t cells = 0;
  double bias = 0;  ///< mean of a - b [m]
  double rmse = 0;  ///< [m]
  double nmad = 0;  ///< 1.4826 median(|d - median(d)|) (Hoehle & Hoehle 2009) [m]
};

/// Statistics of `a - b`; throws Error when the layers differ in size.
DifferenceStatistics difference_statistics(const HeightMap::Layer& a, const HeightMap::Layer& b);

/// `a - b`, unknown where one of them is; throws Error when the layers differ in size.
HeightMap::Layer difference(const HeightMap::Layer& a, const HeightMap::Layer& b);

}  // namespace aeolian
