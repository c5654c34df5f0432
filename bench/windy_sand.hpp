#pragma once

#include "aeolian_core/bedforms/bedforms.hpp"

namespace aeolian {

/// Sand of 0.4 mm in a wind of u* = 0.45 m/s, a little across the grid.
inline Forcing windy_sand() {
  Grain grain;
  grain.diameter = 0.0004;
  return make_forcing(steady_saltation(0.45, grain), 0.3, grain, MeanSplash{});
}

}  // namespace aeolian
