#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/twin/wind_course.hpp"

namespace aeolian {

/// A day of wind on a bed of single grains, as it truly was: what the twin has to learn from, and another
/// model than the one that it forecasts with.
struct LearningDay {
  static constexpr double period = 10;      ///< between surfaces [s]
  static constexpr double duration = 1200;  ///< [s]

  GridGeometry plot;                      ///< periodic
  std::vector<WindSample> wind;           ///< twice a second
  std::vector<HeightMap::Layer> surface;  ///< at 0, period, ...

  const HeightMap::Layer& at(double time) const {
    return surface[static_cast<std::size_t>(time / period + 0.5)];
  }
};

/// The sand of all such days.
Grain learning_grain();

/// The day of a seed: its mean friction velocity is 0.38 to 0.5 m/s with gusts of 12 %, it turns by up to 20
/// degrees to either side, and its ripples are five to ten minutes old when it begins. Days are kept in a
/// folder: one takes some seconds to make.
LearningDay learning_day(std::uint64_t seed, const std::string& folder);

}  // namespace aeolian
