#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/twin/comparison.hpp"

namespace aeolian {

/// Everything that a report shows of a run.
struct Run {
  struct State {               ///< a measured map's ripples
    double time;               ///< since the start [s]
    double wavelength;         ///< [m]
    double height;             ///< [m]
    double known_share;        ///< of the cells
    double friction_velocity;  ///< NaN when unknown [m/s]
  };
  struct Score {
    double time;       ///< of validity, since the start [s]
    double lead_time;  ///< [s]
    Comparison comparison;
  };
  std::string title;
  std::string source;  ///< the bag
  std::vector<State> states;
  std::vector<Score> scores;
  std::size_t forecasts = 0;    ///< made in all, scored or not
  double wind_direction = NAN;  ///< where it blew to, mean [rad], NaN when unknown
  HeightMap measured;  ///< the last measured map that has a forecast, or the last of all when no forecast was
                       ///< scored
  HeightMap
      forecast;  ///< the forecast for that time, longest lead; without layers when no forecast was scored
  double forecast_lead = 0;
  std::optional<HeightMap> truth;  ///< elevation at the same time, when it is known; any grid
  std::vector<State> true_states;  ///< ripples of the true surface over time, when they are known
};

/// Writes index.html with its pictures and CSV tables into a directory: measured map, forecast, difference;
/// growth of wavelength and height; skill against persistence by lead time; a table of every score; the run's
/// own figures. One page that needs no network. Plots are made with gnuplot. Throws Error when the directory
/// cannot be written or there is no measured map.
void write_report(const Run& run, const std::string& directory);

}  // namespace aeolian
