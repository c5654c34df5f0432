#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "aeolian_core/twin/comparison.hpp"
#include "aeolian_core/twin/wind_course.hpp"

namespace aeolian {

/// All that the comparator does but for messages: every forecast is scored against the measured map nearest
/// to the time for which it holds. The node and `replay` share it.
class ForecastScorer {
 public:
  struct Settings {
    double tolerance = 1;  ///< the map compared must be so near to the forecast's time [s]
    double direction = 0;  ///< of the wind until it is known [rad]
    std::size_t max_pending = 100;
    std::size_t max_maps = 20;
  };
  /// A forecast that was scored, or why it was not.
  struct Score {
    double issued = 0;         ///< when the forecast was made [s]
    double time = 0;           ///< for which it holds [s]
    double measured_time = 0;  ///< of the map that it was compared with [s]
    Comparison comparison;
    HeightMap difference;  ///< difference, lod95, elevation (measured), lead_time; on the map's grid
    std::string refused;   ///< one line; empty: it was scored
  };

  explicit ForecastScorer(const Settings& settings) : settings_(settings) {}

  void take_wind(const WindSample& sample);
  /// Both return the scores that they make possible. A map older than the last begins anew: waiting forecasts
  /// are dropped.
  std::vector<Score> take_forecast(std::shared_ptr<const HeightMap> forecast, double time);
  std::vector<Score> take_map(std::shared_ptr<const HeightMap> map, double time);

 private:
  struct Timed {
    double time;
    std::shared_ptr<const HeightMap> map;
  };

  Settings settings_;
  std::deque<Timed> maps_;
  std::deque<Timed> pending_;
  std::deque<WindSample> wind_;
};

}  // namespace aeolian
