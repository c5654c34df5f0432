// make_bag: files of scans, photos and wind to a bag that the nodes can run on.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <geometry_msgs/TwistStamped.h>
#include <rosbag/bag.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/wind/wind_record.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/tools/file_messages.hpp"
#include "aeolian_twin/tools/manifest.hpp"
#include "aeolian_twin/tools/output_bag.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/static_frames.hpp"

namespace aeolian {
namespace {

/// Intervals so many times longer than the usual one are told as gaps of a wind record.
constexpr double gap_intervals = 10;

/// Writes the messages of a manifest in order of their stamps; one file at a time is in memory.
class BagMaker {
 public:
  explicit BagMaker(Manifest manifest) : manifest_(std::move(manifest)) { plan(); }

  void write(rosbag::Bag& bag) {
    bag_ = &bag;
    for (const Step& step : steps_) step.write(step.stamp);
  }

  std::string summary() const {
    const double span = (steps_.back().stamp - steps_.front().stamp).toSec();
    return fmt::format("{} clouds with {} points, {} photos, {} wind samples, {:.3f} s",
                       manifest_.clouds.size(), points_, manifest_.photos.size(), wind_.time.size(), span);
  }

 private:
  struct Step {
    ros::Time stamp;
    std::function<void(const ros::Time&)> write;
  };

  void plan() {
    for (std::size_t i = 0; i < manifest_.clouds.size(); ++i)
      steps_.push_back({manifest_.clouds[i].stamp, [this, i](const ros::Time&) { write_cloud(i); }});
    for (const Manifest::Photo& photo : manifest_.photos)
      steps_.push_back({photo.stamp, [this, &photo](const ros::Time&) { write_photo(photo); }});
    if (manifest_.wind) plan_wind(*manifest_.wind);
    if (steps_.empty()) throw Error("the manifest has neither clouds nor photos nor wind");
    std::stable_sort(steps_.begin(), steps_.end(),
                     [](const Step& a, const Step& b) { return a.stamp < b.stamp; });
    if (manifest_.wind)
      steps_.insert(steps_.begin(), {steps_.front().stamp, [this](const ros::Time& t) { write_mast(t); }});
  }

  void plan_wind(const Manifest::Wind& wind) {
    wind_ = read_wind_record(wind.file);
    if (wind_.time.empty()) throw Error("wind record " + wind.file + ": has no samples");
    for (std::size_t i = 0; i < wind_.time.size(); ++i)
      steps_.push_back(
          {wind_stamp(wind, wind_.time[i]), [this, i](const ros::Time& t) { write_wind(i, t); }});
    warn_of_gaps(wind);
  }

  static ros::Time wind_stamp(const Manifest::Wind& wind, double t_s) {
    const double seconds = static_cast<double>(wind.start.sec) + t_s;
    if (!(seconds >= 1e-9 && seconds < std::numeric_limits<std::uint32_t>::max()))
      throw Error(
          fmt::format("wind record {}: t_s {} after the start {} is no time that ROS can hold "
                      "(wind.start of the manifest sets the time of t_s = 0)",
                      wind.file, t_s, wind.start.sec));
    return wind.start + ros::Duration(t_s);
  }

  void warn_of_gaps(const Manifest::Wind& wind) const {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < wind_.time.size(); ++i)
      intervals.push_back(wind_.time[i] - wind_.time[i - 1]);
    if (intervals.empty()) return;
    const double usual = median(intervals);
    for (const WindRecord::Gap& gap : wind_.gaps(gap_intervals * usual))
      fmt::print(
          stderr,
          "make_bag: warning: wind record {}: nothing from t_s {} to {} ({} s between samples is usual)\n",
          wind.file, gap.start, gap.end, usual);
  }

  template <class Message>
  void write(const std::string& topic, const std::string& frame, const ros::Time& stamp, Message message) {
    message.header.stamp = stamp;
    message.header.frame_id = frame;
    bag_->write(topic, stamp, message);
  }

  geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                            const Eigen::Isometry3d& pose, const ros::Time& stamp) const {
    geometry_msgs::TransformStamped message = tf2::eigenToTransform(pose);
    message.header.stamp = stamp;
    message.header.frame_id = parent;
    message.child_frame_id = child;
    return message;
  }

  void write_cloud(std::size_t number) {
    const Manifest::Cloud& entry = manifest_.clouds[number];
    const PointCloud cloud = number == 0 && first_cloud_ ? std::move(*first_cloud_) : read_cloud(entry.file);
    const Eigen::Translation3d origin(cloud.origin_x, cloud.origin_y, cloud.origin_z);
    tf2_msgs::TFMessage frames;
    std::string frame = entry.frame;
    if (entry.pose)
      frames.transforms.push_back(transform(manifest_.frame_id, frame, *entry.pose, entry.stamp));
    if (!origin.vector().isZero(0)) {
      const std::string own = fmt::format("cloud_{}", number);
      frames.transforms.push_back(transform(frame, own, Eigen::Isometry3d(origin), entry.stamp));
      frame = own;
    }
    if (!frames.transforms.empty()) bag_->write("/tf", entry.stamp, frames);
    write("/points", frame, entry.stamp, to_message(cloud));
    points_ += cloud.size();
  }

  void write_photo(const Manifest::Photo& photo) {
    sensor_msgs::Image image = read_image(photo.file);
    sensor_msgs::CameraInfo info = read_camera_info(photo.camera_info);
    if (image.width != info.width || image.height != info.height)
      throw Error(fmt::format("photo '{}': has {} x {} pixels, its camera_info '{}' is for {} x {}",
                              photo.file, image.width, image.height, photo.camera_info, info.width,
                              info.height));
    if (photo.pose) {
      tf2_msgs::TFMessage frames;
      frames.transforms.push_back(transform(manifest_.frame_id, photo.frame, *photo.pose, photo.stamp));
      bag_->write("/tf", photo.stamp, frames);
    }
    write("/image", photo.frame, photo.stamp, std::move(image));
    write("/camera_info", photo.frame, photo.stamp, std::move(info));
  }

  void write_wind(std::size_t sample, const ros::Time& stamp) {
    geometry_msgs::TwistStamped message;
    message.twist.linear.x = wind_.speed[sample] * std::cos(wind_.direction[sample]);
    message.twist.linear.y = wind_.speed[sample] * std::sin(wind_.direction[sample]);
    write("/wind", "anemometer", stamp, std::move(message));
  }

  /// The anemometer's place.
  void write_mast(const ros::Time& stamp) {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation().z() = ground() + manifest_.wind->height;
    tf2_msgs::TFMessage frames;
    frames.transforms.push_back(transform(manifest_.frame_id, "anemometer", place, stamp));
    write_static_frames(*bag_, frames, stamp, "make_bag");
  }

  /// The ground's height in the map: the median of the first cloud, zero when its place in the map is not
  /// known.
  double ground() {
    if (manifest_.clouds.empty()) return 0;
    const Manifest::Cloud& entry = manifest_.clouds.front();
    if (!entry.pose && entry.frame != manifest_.frame_id) return 0;
    first_cloud_ = read_cloud(entry.file);
    const Eigen::Isometry3d pose = entry.pose.value_or(Eigen::Isometry3d::Identity());
    const Eigen::Vector3d origin(first_cloud_->origin_x, first_cloud_->origin_y, first_cloud_->origin_z);
    std::vector<double> heights;
    for (std::size_t i = 0; i < first_cloud_->size(); ++i) {
      const Eigen::Vector3f point(first_cloud_->x[i], first_cloud_->y[i], first_cloud_->z[i]);
      if (point.allFinite()) heights.push_back((pose * (origin + point.cast<double>())).z());
    }
    return median(heights);
  }

  Manifest manifest_;
  WindRecord wind_;
  std::vector<Step> steps_;
  std::optional<PointCloud> first_cloud_;  ///< read early for the ground's height
  std::size_t points_ = 0;
  rosbag::Bag* bag_ = nullptr;
};

std::string make_bag(const std::string& manifest, const std::string& out) {
  BagMaker maker(ManifestReader(manifest).read());
  write_bag_atomically(out, [&](rosbag::Bag& bag) { maker.write(bag); });
  return maker.summary();
}

constexpr const char* description =
    R"(Turns files of scans, photos and wind into a bag that the nodes can run on.

MANIFEST.yaml (config/manifest.example.yaml is a commented one; paths are relative to it):
  frame_id: map                                   (default)
  clouds:
    - {file: scan.pcd, stamp: 1700000000.25, frame: scanner, pose: [x, y, z, qx, qy, qz, qw]}
  photos:
    - {file: photo.jpg, stamp: 1700000001, camera_info: camera.yaml, frame: camera, pose: [...]}
  wind: {file: wind.csv, height_m: 1.0, start: 1700000000}

Clouds: PCD, PLY, XYZ, CSV, TXT or GeoTIFF, to /points. pose is the sensor's in frame_id and goes to /tf; without one
the points are in `frame`, or in frame_id. Coordinates beyond 1000 m go to /points about an origin of whole metres in
a frame cloud_N, whose place goes to /tf: no float holds a large number.
Photos: to /image and /camera_info (camera.yaml as ROS' camera_calibration writes it).
Wind: columns t_s, speed_m_s and direction_deg (where it blows to, counter-clockwise from east) or from_deg
(meteorological), to /wind in the frame anemometer, which stands on /tf_static height_m above the ground: the median
height of the first cloud, or 0.
Times: seconds on one clock, read to the nanosecond; t_s counts from wind.start (default 0).)";

int run(int argc, char** argv) {
  CLI::App app(description);
  std::string manifest;
  std::string bag;
  app.add_option("MANIFEST", manifest, "YAML file that lists the files")->required();
  app.add_option("BAG", bag, "bag to write")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  fmt::print("{}: {}\n", bag, make_bag(manifest, bag));
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("make_bag", [&] { return aeolian::run(argc, argv); });
}
