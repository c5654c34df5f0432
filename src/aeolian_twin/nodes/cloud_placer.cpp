#include "aeolian_twin/nodes/cloud_placer.hpp"

#include <utility>

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

CloudPlacer::CloudPlacer(const SensorSettings& sensor, const Frames& frames, Use use, Tell tell)
    : sensor_(sensor), frames_(frames), use_(std::move(use)), tell_(std::move(tell)) {
  this->tell("clouds", false, "no cloud has arrived on " + sensor_.topic);
}

void CloudPlacer::tell(const std::string& thing, bool well, const std::string& line) {
  tell_(sensor_.thing(thing), well, line);
}

void CloudPlacer::watch() {
  if (waiting_ > 0 && ros::WallTime::now() - waiting_since_ > frames_.patience)
    tell_of_transform(waiting_header_);
}

bool CloudPlacer::arrived(const std_msgs::Header& header) {
  if (waiting_++ == 0) waiting_since_ = ros::WallTime::now();
  waiting_header_ = header;
  const ros::Time stamp = header.stamp;
  bool forget = false;
  if (stamp < newest_arrived_) {
    tell("clock", false,
         fmt::format("time jumped back by {:.1f} s (a bag that loops?), the map is kept",
                     (newest_arrived_ - stamp).toSec()));
    // Transforms of the time before the jump would make tf refuse the new ones as too old.
    if (!frames_.buffer.canTransform(frames_.map, header.frame_id, stamp)) {
      frames_.buffer.clear();
      waiting_ = 1;
      forget = true;
    }
  } else if (!newest_arrived_.isZero()) {
    tell("clock", true, "time runs forward");
  }
  newest_arrived_ = stamp;
  return forget;
}

void CloudPlacer::dropped(const std_msgs::Header& header) {
  if (waiting_ > 0) --waiting_;
  tell_of_transform(header);
}

void CloudPlacer::tell_of_transform(const std_msgs::Header& header) {
  std::string reason = "the cloud's frame_id is empty";
  if (!header.frame_id.empty())
    frames_.buffer.canTransform(frames_.map, header.frame_id, header.stamp, &reason);
  tell("transform", false,
       fmt::format("no transform from '{}' to '{}': {}", header.frame_id, frames_.map, reason));
}

void CloudPlacer::take_if(const std_msgs::Header& header, const std::function<void(const Place&)>& use) {
  waiting_ = 0;
  try {
    // A time of zero would ask tf for its newest.
    const bool early = header.stamp - ros::Time(0) <= sensor_.latency;
    const ros::Time measured = early ? header.stamp : header.stamp - sensor_.latency;
    const Eigen::Isometry3d pose =
        tf2::transformToEigen(frames_.buffer.lookupTransform(frames_.map, header.frame_id, measured));
    tell("transform", true, fmt::format("from '{}' to '{}' is known", header.frame_id, frames_.map));
    use({pose, measured});
  } catch (const tf2::TransformException& error) {
    tell("transform", false, error.what());
  } catch (const Error& error) {
    tell("clouds", false, sensor_.topic + ": " + error.what());
  }
}

}  // namespace aeolian
