#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <ros/time.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {

/// What make_bag turns into a bag; config/manifest.example.yaml explains the keys. Paths are complete.
struct Manifest {
  struct Cloud {
    std::string file;
    ros::Time stamp;
    std::string frame;                      ///< that the file's coordinates are in
    std::optional<Eigen::Isometry3d> pose;  ///< of that frame in the map
  };
  struct Photo {
    std::string file;
    std::string camera_info;
    ros::Time stamp;
    std::string frame;
    std::optional<Eigen::Isometry3d> pose;
  };
  struct Wind {
    std::string file;
    double height;    ///< over the ground [m]
    ros::Time start;  ///< the time of t_s = 0
  };
  std::string frame_id = "map";
  std::vector<Cloud> clouds;
  std::vector<Photo> photos;
  std::optional<Wind> wind;
};

/// Seconds as decimal text to the nanosecond, which a double of this size would lose; nothing for anything
/// else.
inline std::optional<ros::Time> parse_stamp(std::string_view text) {
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  std::string fraction(point == std::string_view::npos ? "" : text.substr(point + 1));
  const bool digits = text.find_first_not_of("0123456789.") == std::string_view::npos &&
                      fraction.find('.') == std::string::npos;
  if (!digits || whole.empty() || whole.size() > 10 || fraction.size() > 9) return std::nullopt;
  fraction.resize(9, '0');
  const std::uint64_t seconds = std::stoull(std::string(whole));
  if (seconds > UINT32_MAX) return std::nullopt;
  return ros::Time(static_cast<std::uint32_t>(seconds), static_cast<std::uint32_t>(std::stoul(fraction)));
}

/// Reads a manifest, each value checked; throws Error that names file, line, key and value.
class ManifestReader {
 public:
  explicit ManifestReader(const std::string& path)
      : root_(YamlSection::load(path)), folder_(std::filesystem::path(path).parent_path()) {}

  Manifest read() {
    Manifest manifest;
    if (root_.has("frame_id")) manifest.frame_id = frame(root_, "frame_id");
    if (root_.has("clouds"))
      for (YamlSection& section : root_.sections("clouds"))
        manifest.clouds.push_back(cloud(section, manifest.frame_id, manifest.clouds.size()));
    if (root_.has("photos"))
      for (YamlSection& section : root_.sections("photos"))
        manifest.photos.push_back(photo(section, manifest.frame_id));
    if (root_.has("wind")) manifest.wind = wind();
    root_.finish();
    return manifest;
  }

 private:
  Manifest::Cloud cloud(YamlSection& section, const std::string& map_frame, std::size_t number) const {
    Manifest::Cloud cloud{path(section, "file"), stamp(section, "stamp"), map_frame, pose(section)};
    if (cloud.pose) cloud.frame = fmt::format("sensor_{}", number);
    if (section.has("frame")) cloud.frame = frame(section, "frame");
    if (cloud.pose && cloud.frame == map_frame)
      section.refuse("frame", "must be another than frame_id when there is a pose");
    section.finish();
    return cloud;
  }

  Manifest::Photo photo(YamlSection& section, const std::string& map_frame) const {
    Manifest::Photo photo{path(section, "file"), path(section, "camera_info"), stamp(section, "stamp"),
                          "camera", pose(section)};
    if (section.has("frame")) photo.frame = frame(section, "frame");
    if (photo.pose && photo.frame == map_frame)
      section.refuse("frame", "must be another than frame_id when there is a pose");
    section.finish();
    return photo;
  }

  Manifest::Wind wind() {
    YamlSection section = root_.section("wind");
    Manifest::Wind wind{path(section, "file"), section.positive("height_m", 1000), ros::Time()};
    if (section.has("start")) wind.start = time(section, "start");
    section.finish();
    return wind;
  }

  std::string path(YamlSection& section, const std::string& key) const {
    return (folder_ / section.text(key)).string();
  }

  static std::string frame(YamlSection& section, const std::string& key) {
    const std::string name = section.text(key);
    if (name.front() == '/' || name.find(' ') != std::string::npos)
      section.refuse(key, "must be a tf2 frame: no leading slash, no blanks");
    return name;
  }

  static ros::Time time(YamlSection& section, const std::string& key) {
    const auto time = parse_stamp(section.text(key));
    if (!time) section.refuse(key, "must be seconds with at most 9 decimals, like 1700000000.25");
    return *time;
  }

  static ros::Time stamp(YamlSection& section, const std::string& key) {
    const ros::Time stamp = time(section, key);
    if (stamp.isZero()) section.refuse(key, "must be greater than 0, which ROS takes for no time");
    return stamp;
  }

  static std::optional<Eigen::Isometry3d> pose(YamlSection& section) {
    if (!section.has("pose")) return std::nullopt;
    const std::vector<double> p = section.numbers("pose", 7);
    Eigen::Quaterniond rotation(p[6], p[3], p[4], p[5]);
    constexpr double tolerance = 1e-3;
    if (!(std::abs(rotation.norm() - 1) <= tolerance))
      section.refuse("pose", fmt::format("has a quaternion of length {:g}, must be 1", rotation.norm()));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation.normalized().toRotationMatrix();
    pose.translation() << p[0], p[1], p[2];
    return pose;
  }

  YamlSection root_;
  std::filesystem::path folder_;
};

}  // namespace aeolian
