#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "aeolian_core/bedforms/bedforms.hpp"
#include "aeolian_core/measure/measure.hpp"
#include "aeolian_core/surface/yaml_section.hpp"
#include "aeolian_core/wind/wind.hpp"

namespace aeolian {

/// What happens on a virtual field day: config/field_day.yaml in numbers.
struct FieldDay {
  double start = 0;     ///< stamp of the beginning [s]
  double duration = 0;  ///< [s]
  std::uint64_t seed = 0;

  GridGeometry plot;  ///< cells of the truth
  Grain grain;
  double lattice_spacing = 0;  ///< [m]
  double spin_up = 0;          ///< time that the bed has had mean wind before the beginning [s]

  VirtualAnemometer anemometer;
  double wind_rate = 0;  ///< [Hz]
  Eigen::Isometry3d anemometer_pose = Eigen::Isometry3d::Identity();

  std::vector<VirtualScanner> scanners;
  double scan_period = 0;  ///< [s]

  VirtualCamera camera;
  double photo_period = 0;  ///< [s]
  Straightedge straightedge;
  Eigen::Vector3d light = -Eigen::Vector3d::UnitZ();  ///< the way it travels
};

/// The pose of a sensor at `position` whose z axis points at `target`: x to the right, y down; for one that
/// looks straight down, north is up.
inline Eigen::Isometry3d look_at(const Eigen::Vector3d& position, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - position).normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < 1e-6) right = forward.cross(Eigen::Vector3d::UnitY());
  right.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  return pose;
}

/// The frame of a straightedge that is level across: origin at the casting edge's start, x along it, z up.
inline Eigen::Isometry3d straightedge_pose(const Straightedge& edge) {
  const Eigen::Vector3d along = (edge.end - edge.start).normalized();
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(along).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = edge.start;
  pose.linear() << along, across, along.cross(across);
  return pose;
}

inline Eigen::Isometry3d read_pose(YamlSection& section) {
  const Eigen::Vector3d position = section.point("position_m");
  const Eigen::Vector3d target = section.point("looks_at_m");
  if ((target - position).norm() < 1e-6)
    throw Error("field day: a sensor's looks_at_m equals its position_m");
  return look_at(position, target);
}

inline double read_angle(YamlSection& section, const std::string& key, double low_deg, double high_deg) {
  return degrees_to_radians(section.number(key, low_deg, high_deg));
}

inline void read_bed(YamlSection section, FieldDay& day) {
  const double length = section.positive("length_m", 100);
  const double width = section.positive("width_m", 100);
  const double cell = section.positive("truth_cell_m", std::min(length, width));
  day.plot = GridGeometry::covering(0, 0, length, width, cell);
  day.grain.diameter = section.number("grain_diameter_m", 5e-5, 5e-3);
  day.lattice_spacing = section.number("lattice_spacing_m", 1e-5, 0.25 * std::min(length, width));
  day.spin_up = 60 * section.number("spin_up_minutes", 0, 1e4);
  section.finish();
}

inline void read_wind(YamlSection section, FieldDay& day) {
  VirtualAnemometer& a = day.anemometer;
  const Eigen::Vector3d position = section.point("anemometer_m");
  if (!(position.z() > grain_roughness(day.grain.diameter)))
    throw Error(
        fmt::format("field day: wind.anemometer_m is {} m high, must be above the bed", position.z()));
  day.anemometer_pose.translation() = position;
  a.height = position.z();
  a.mean_speed = section.number("mean_speed_m_s", 0, 100);
  a.gust_intensity = section.number("gust_intensity", 0, 2);
  a.gust_time = section.positive("gust_time_s");
  a.direction = read_angle(section, "direction_deg", -360, 360);
  a.direction_sigma = read_angle(section, "direction_sigma_deg", 0, 180);
  day.wind_rate = section.number("rate_hz", 1, 1000);
  section.finish();
}

inline void read_scanners(YamlSection section, FieldDay& day) {
  VirtualScanner common;
  day.scan_period = section.positive("period_s");
  common.columns = section.integer("columns", 1, 10000);
  common.rows = section.integer("rows", 1, 10000);
  common.field_of_view_x = read_angle(section, "field_of_view_across_deg", 0.01, 179);
  common.field_of_view_y = read_angle(section, "field_of_view_along_deg", 0.01, 179);
  common.range_sigma = section.number("range_sigma_m", 0, 1);
  common.dropout = section.number("dropout", 0, 1);
  for (YamlSection& tripod : section.sections("tripods")) {
    common.pose = read_pose(tripod);
    tripod.finish();
    day.scanners.push_back(common);
  }
  section.finish();
}

inline void read_camera(YamlSection section, FieldDay& day) {
  VirtualCamera& c = day.camera;
  day.photo_period = section.positive("period_s");
  c.width_px = section.integer("width_px", 1, 20000);
  c.height_px = section.integer("height_px", 1, 20000);
  c.focal_px = section.positive("focal_px");
  c.noise = section.number("noise", 0, 1);
  c.pose = read_pose(section);
  section.finish();
}

inline void read_shadow(YamlSection section, FieldDay& day) {
  day.straightedge.start = section.point("edge_start_m");
  day.straightedge.end = section.point("edge_end_m");
  if (!((day.straightedge.end - day.straightedge.start).head<2>().norm() > 1e-6))
    section.refuse("edge_end_m", "must lie apart from edge_start_m, seen from above");
  day.straightedge.width = section.positive("edge_width_m", 10);
  day.camera.sun_diameter = degrees_to_radians(section.positive("sun_diameter_deg", 90));
  const double elevation = read_angle(section, "sun_elevation_deg", 1, 90);
  const double towards = read_angle(section, "light_travels_to_deg", -360, 360);
  day.light = {std::cos(elevation) * std::cos(towards), std::cos(elevation) * std::sin(towards),
               -std::sin(elevation)};
  section.finish();
}

/// The setup file of the day's photographs (docs/measure_photo.md), for poses from tf: without marks.
inline std::string shadow_setup(const FieldDay& day) {
  const Eigen::Isometry3d edge = straightedge_pose(day.straightedge);
  const Eigen::Vector3d along = Eigen::Vector3d(edge(0, 0), edge(1, 0), 0).normalized();
  const double across = day.light.dot(Eigen::Vector3d::UnitZ().cross(along));
  const Eigen::Vector3d wind(std::cos(day.anemometer.direction), std::sin(day.anemometer.direction), 0);
  const Eigen::Vector3d on_photo = day.camera.pose.linear().transpose() * wind;
  return fmt::format(
      "# The light over the straightedge of a virtual field day; the camera's place is in tf.\n"
      "light: {{elevation_deg: {:.6g}, azimuth_deg: {:.6g}}}\n"
      "straightedge: {{inclination_deg: {:.6g}, shadow_side: {}}}\n"
      "grain_diameter_mm: {:.6g}\n"
      "wind_px: [{:.6f}, {:.6f}]\n",
      radians_to_degrees(std::asin(-day.light.z())),
      radians_to_degrees(std::atan2(day.light.dot(along), std::abs(across))),
      radians_to_degrees(std::asin(edge(2, 0))), across > 0 ? 1 : -1, 1e3 * day.grain.diameter, on_photo.x(),
      on_photo.y());
}

/// Reads the file; throws Error that names what is wrong with it.
inline FieldDay read_field_day(const std::string& path) {
  YamlSection root = YamlSection::load(path);
  FieldDay day;
  day.start = root.number("start_stamp_s", 0, 4e9);
  day.duration = 60 * root.positive("minutes", 1e4);
  day.seed = static_cast<std::uint64_t>(root.number("seed", 0, 9e15));
  read_bed(root.section("bed"), day);
  read_wind(root.section("wind"), day);
  read_scanners(root.section("scanners"), day);
  read_camera(root.section("camera"), day);
  read_shadow(root.section("shadow"), day);
  root.finish();
  return day;
}

}  // namespace aeolian
