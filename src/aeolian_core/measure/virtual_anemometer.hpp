#pragma once

#include <cstdint>
#include <vector>

namespace aeolian {

/// A gusty wind at one height: mean speed and direction with first-order autoregressive fluctuations
/// (Ornstein-Uhlenbeck).
struct VirtualAnemometer {
  double height = 1.0;            ///< over the bed [m]
  double mean_speed = 8.0;        ///< [m/s]
  double gust_intensity = 0.12;   ///< standard deviation / mean of the speed
  double gust_time = 8.0;         ///< correlation time [s]
  double direction = 0.0;         ///< mean, the way the wind blows to, counter-clockwise from east [rad]
  double direction_sigma = 0.07;  ///< standard deviation of the direction [rad]

  struct Sample {
    double time;       ///< [s]
    double speed;      ///< [m/s], never negative
    double direction;  ///< [rad]
  };
  /// Samples at 0, 1/rate, ... below `duration` [s].
  std::vector<Sample> record(double duration, double rate, std::uint64_t seed) const;
};

}  // namespace aeolian
