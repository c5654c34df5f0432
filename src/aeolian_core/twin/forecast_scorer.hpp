#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aeolian_core/twin/comparison.hpp"
#include "aeolian_core/twin/wind_course.hpp"

namespace aeolian {

/// All that the comparator does but for messages: every forecast is scored against the measured map nearest
/// to the time for which it holds. The node and `replay` share it.
///
/// Times are seconds on any clock that resolves a nanosecond, so not since 1970; they are told apart to one.
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
  /// What a forecast or a map leads to.
  struct Taken {
    std::vector<Score> scores;
    bool oldest_dropped = false;  ///< more than max_pending forecasts wait
    /// Time jumped back: so many waiting forecasts, and all maps and winds, were dropped.
    std::optional<std::size_t> begun_anew;
  };

  explicit ForecastScorer(const Settings& settings) : settings_(settings) {}

  void take_wind(const WindSample& sample);
  /// A map with layers elevation, initial and lead_time.
  Taken take_forecast(std::shared_ptr<const HeightMap> forecast, double time);
  /// A map with elevation and, if known, variance. One that is older than the last begins anew.
  Taken take_map(std::shared_ptr<const HeightMap> map, double time);

  /// Takes back a map of differences that is no longer needed: its memory serves for the next.
  void reuse(HeightMap difference) { spare_ = std::move(difference); }
  /// The newest map; null before the first.
  std::shared_ptr<const HeightMap> newest_map() const { return maps_.empty() ? nullptr : maps_.back().map; }

 private:
  struct Timed {
    double time;
    std::shared_ptr<const HeightMap> map;
  };

  std::vector<Score> score_due();
  Score score(const Timed& forecast);
  const Timed& nearest_map(double time) const;
  double wind_direction(double from, double to) const;

  Settings settings_;
  std::deque<Timed> maps_;     ///< the newest measured maps, oldest first
  std::deque<Timed> pending_;  ///< forecasts whose time has not come
  std::deque<WindSample> wind_;
  HeightMap spare_;
};

}  // namespace aeolian
