#pragma once

#include <string>
#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Layers of a forecast beside `elevation`.
namespace layer {
inline const std::string initial = "initial";      ///< the measured elevation from which it started [m]
inline const std::string lead_time = "lead_time";  ///< from the start to the time of validity [s]
}  // namespace layer

/// A surface as predicted for one horizon.
struct Forecast {
  double lead_time = 0;  ///< [s]
  HeightMap map;         ///< layers elevation, initial, lead_time; unknown where the start was
  VolumeBalance volume;  ///< since the start
};

/// A forcing that holds until a lead time [s].
struct ForcingSpell {
  double until = 0;
  Forcing forcing;
};

/// Runs a bed model from a measured map to each horizon [s, positive, increasing] under one forcing. The run
/// goes on from one horizon to the next. Throws Error naming a bad horizon or a map without elevation or any
/// known cell.
std::vector<Forecast> make_forecasts(const HeightMap& start, const Forcing& forcing,
                                     const std::vector<double>& horizons, BedModel& model);
/// The same under forcings that follow each other. Throws Error as well for spells that do not increase or
/// that end before the last horizon.
std::vector<Forecast> make_forecasts_in_turn(const HeightMap& start,
                                             const std::vector<ForcingSpell>& forcings,
                                             const std::vector<double>& horizons, BedModel& model);

}  // namespace aeolian
