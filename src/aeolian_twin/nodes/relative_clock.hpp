#pragma once

#include <cmath>
#include <cstdint>

#include <ros/time.h>

namespace aeolian {

/// Between ROS' stamps and seconds since some epoch: doubles hold the nanoseconds of some months, but not
/// those since 1970.
class RelativeClock {
 public:
  /// Seconds since the first stamp that was asked for.
  double seconds(const ros::Time& stamp) {
    if (epoch_.isZero()) epoch_ = stamp;
    return static_cast<double>(nanoseconds(stamp) - nanoseconds(epoch_)) / 1e9;
  }
  ros::Time stamp(double seconds) const {
    ros::Time stamp;
    stamp.fromNSec(static_cast<std::uint64_t>(nanoseconds(epoch_) + std::llround(seconds * 1e9)));
    return stamp;
  }

 private:
  static std::int64_t nanoseconds(const ros::Time& stamp) {
    return static_cast<std::int64_t>(stamp.toNSec());
  }

  ros::Time epoch_;
};

}  // namespace aeolian
