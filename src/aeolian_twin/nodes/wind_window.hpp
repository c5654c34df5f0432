#pragma once

#include <cstddef>
#include <deque>
#include <limits>

#include <Eigen/Core>

namespace aeolian {

/// Gusts of a record, in the terms of meteorologists; not a number where there are too few readings.
struct GustStatistics {
  std::size_t readings = 0;
  double duration = 0;                                                     ///< first to last reading [s]
  double speed = std::numeric_limits<double>::quiet_NaN();                 ///< of the mean velocity [m/s]
  double direction = std::numeric_limits<double>::quiet_NaN();             ///< where that blows to [rad]
  double deviation_along = std::numeric_limits<double>::quiet_NaN();       ///< standard, along it [m/s]
  double deviation_across = std::numeric_limits<double>::quiet_NaN();      ///< [m/s]
  double turbulence_intensity = std::numeric_limits<double>::quiet_NaN();  ///< deviation_along/speed
  double gust = std::numeric_limits<double>::quiet_NaN();        ///< greatest mean speed of 3 s [m/s]
  double gust_ratio = std::numeric_limits<double>::quiet_NaN();  ///< gust/speed
};

/// The newest readings of one anemometer.
class WindWindow {
 public:
  /// Readings are kept for `length` [s].
  explicit WindWindow(double length) : length_(length) {}

  /// Velocity east and north [m/s]. A time before the last one begins anew.
  void add(double time, const Eigen::Vector2d& velocity);
  bool empty() const { return readings_.empty(); }
  /// [s]; of one that is not empty.
  double last() const { return readings_.back().time; }
  /// Over the readings younger than `duration` [s] at the last one, which always counts; of one that is not
  /// empty.
  Eigen::Vector2d mean(double duration) const;
  GustStatistics statistics() const;

 private:
  struct Reading {
    double time;
    Eigen::Vector2d velocity;
  };
  double greatest_gust() const;

  double length_;
  std::deque<Reading> readings_;
};

}  // namespace aeolian
