#pragma once

#include "aeolian_core/grains/splash/splash_table.hpp"

namespace aeolian {

/// The events of one node before they are put onto the grid.
struct SplashTable::Gathered {
  std::array<double, 4> place;      ///< as in axis()
  std::vector<StoredEvent> events;  ///< `first` counts within `ejecta`
  std::vector<Ejectum> ejecta;
};

}  // namespace aeolian
