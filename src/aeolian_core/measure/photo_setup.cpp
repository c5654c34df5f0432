#include "aeolian_core/measure/photo_setup.hpp"

#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "aeolian_core/measure/scale_marks.hpp"
#include "aeolian_core/measure/sun_position.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {
namespace {

constexpr double millimetre = 1e-3;
constexpr double lowest_light = 3;    ///< [degrees]
constexpr double highest_light = 85;  ///< [degrees]
constexpr int largest_side = 1 << 20;
constexpr double farthest_mm = 100'000;

/// Nine or more numbers as a plain list or as {rows, cols, data}.
std::vector<double> matrix(YamlSection& section, const std::string& key, std::size_t count = 0) {
  if (section.is_list(key)) return section.numbers(key, count);
  YamlSection table = section.section(key);
  const int rows = table.integer("rows", 1, 100);
  const int columns = table.integer("cols", 1, 100);
  std::vector<double> values =
      table.numbers("data", static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  if (count > 0 && values.size() != count)
    table.refuse("data", fmt::format("must be a list of {} numbers", count));
  table.finish();
  return values;
}

Eigen::Vector2d pixel(YamlSection& section, const std::string& key) {
  const std::vector<double> values = section.numbers(key, 2);
  return {values[0], values[1]};
}

/// A direction on the photo.
Eigen::Vector2d direction(YamlSection& section, const std::string& key) {
  Eigen::Vector2d result = pixel(section, key);
  if (result.isZero()) section.refuse(key, "must not be zero");
  return result;
}

void read_distortion(YamlSection& section, CameraModel& camera) {
  const std::string model = section.text("distortion_model");
  const std::vector<double> values = matrix(section, "distortion_coefficients");
  if (model == "plumb_bob") {
    if (values.size() != 4 && values.size() != 5)
      section.refuse("distortion_coefficients", "must be 4 or 5 numbers for plumb_bob");
  } else if (model == "rational_polynomial") {
    if (values.size() != 8)
      section.refuse("distortion_coefficients", "must be 8 numbers for rational_polynomial");
  } else {
    section.refuse("distortion_model", "must be plumb_bob or rational_polynomial");
  }
  std::copy(values.begin(), values.end(), camera.distortion.begin());
}

CameraModel read_camera_model(YamlSection& section) {
  CameraModel camera;
  camera.width_px = section.integer("image_width", 1, largest_side);
  camera.height_px = section.integer("image_height", 1, largest_side);
  const std::vector<double> k = matrix(section, "camera_matrix", 9);
  if (!(k[0] > 0 && k[4] > 0 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1))
    section.refuse("camera_matrix", "must be [fx, 0, cx, 0, fy, cy, 0, 0, 1] with positive fx and fy");
  if (k[1] != 0) section.refuse("camera_matrix", fmt::format("has a skew of {:g}, must be without", k[1]));
  camera.fx = k[0];
  camera.fy = k[4];
  camera.cx = k[2];
  camera.cy = k[5];
  if (section.has("distortion_model") || section.has("distortion_coefficients"))
    read_distortion(section, camera);
  for (const char* key : {"camera_name", "rectification_matrix", "projection_matrix"}) section.ignore(key);
  return camera;
}

void read_camera(YamlSection section, PhotoSetup& setup) {
  if (section.has("plumb")) setup.plumb = section.flag("plumb");
  const bool calibrated = section.has("camera_matrix") || section.has("image_width") ||
                          section.has("image_height") || section.has("distortion_model") ||
                          section.has("distortion_coefficients");
  if (calibrated) setup.camera = read_camera_model(section);
  section.finish();
}

/// How many markers each dictionary of OpenCV holds; 0 when there is no such.
int markers_in(const std::string& dictionary) {
  for (const int side : {4, 5, 6, 7})
    for (const int count : {50, 100, 250, 1000})
      if (dictionary == fmt::format("DICT_{0}X{0}_{1}", side, count)) return count;
  struct Named {
    const char* name;
    int count;
  };
  constexpr std::array<Named, 5> others = {{{"DICT_ARUCO_ORIGINAL", 1024},
                                            {"DICT_APRILTAG_16h5", 30},
                                            {"DICT_APRILTAG_25h9", 35},
                                            {"DICT_APRILTAG_36h10", 2320},
                                            {"DICT_APRILTAG_36h11", 587}}};
  for (const Named& other : others)
    if (dictionary == other.name) return other.count;
  return 0;
}

PhotoSetup::Markers read_markers(YamlSection section) {
  PhotoSetup::Markers markers;
  markers.dictionary = section.text("dictionary");
  const int count = markers_in(markers.dictionary);
  if (count == 0)
    section.refuse("dictionary",
                   "must be one of OpenCV's: DICT_4X4_50 to DICT_7X7_1000, DICT_ARUCO_ORIGINAL, "
                   "DICT_APRILTAG_16h5, 25h9, 36h10 or 36h11");
  markers.size = millimetre * section.positive("size_mm", 1000);
  const auto rows = section.rows("centres_mm", 3, 3, -farthest_mm, farthest_mm);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PhotoSetup::Markers::Centre centre{static_cast<int>(rows[i][0]),
                                             millimetre * Eigen::Vector2d(rows[i][1], rows[i][2])};
    if (centre.id != rows[i][0] || centre.id < 0 || centre.id >= count)
      section.refuse_element("centres_mm", i,
                             fmt::format("must start with a number of {}: a whole one from 0 to {}",
                                         markers.dictionary, count - 1));
    for (const auto& other : markers.centres) {
      if (other.id == centre.id)
        section.refuse_element("centres_mm", i, fmt::format("marker {} is already in the list", centre.id));
      if ((other.position - centre.position).cwiseAbs().maxCoeff() < markers.size)
        section.refuse_element("centres_mm", i, fmt::format("overlaps marker {}", other.id));
    }
    markers.centres.push_back(centre);
  }
  section.finish();
  return markers;
}

std::vector<PhotoSetup::ScaleMark> read_scale(YamlSection& section) {
  const std::string key = "scale_px_mm";
  std::vector<PhotoSetup::ScaleMark> marks;
  for (const std::vector<double>& row : section.rows(key, 3, 4, -farthest_mm, largest_side)) {
    marks.push_back({{row[0], row[1]}, millimetre * row[2], std::nullopt});
    if (row.size() == 4) marks.back().y = millimetre * row[3];
  }
  if (const auto fault = contradiction(marks)) section.refuse_element(key, fault->mark, fault->reason);
  return marks;
}

/// The top face lies on one side of the casting edge.
void check_sides(const YamlSection& section, const PhotoSetup& setup) {
  bool left = false;
  bool right = false;
  const auto see = [&](double y) {
    left = left || y > 0;
    right = right || y < 0;
  };
  for (const auto& mark : setup.scale) see(mark.y.value_or(0));
  if (setup.markers)
    for (const auto& centre : setup.markers->centres) see(centre.position.y());
  if (left && right)
    section.refuse(setup.scale.empty() ? "markers" : "scale_px_mm",
                   "has y of both signs, must be on one side of the casting edge (y = 0)");
  if ((setup.shadow_side > 0 && left) || (setup.shadow_side < 0 && right))
    section.refuse("shadow_side", "must be away from the marks: the top face lies on the light's side");
}

int read_shadow_side(YamlSection& section) {
  const int side = section.integer("shadow_side", -1, 1);
  if (side == 0) section.refuse("shadow_side", "must be 1 (towards y > 0) or -1");
  return side;
}

void read_straightedge(YamlSection section, PhotoSetup& setup) {
  if (section.has("line_px")) {
    for (const std::vector<double>& point : section.rows("line_px", 2, 2, -largest_side, largest_side))
      setup.line_px.emplace_back(point[0], point[1]);
    if (setup.line_px.size() < 2 || setup.line_px.front().isApprox(setup.line_px.back()))
      section.refuse("line_px", "must be at least two points [x, y] apart from one another");
  }
  if (section.has("scale_px_mm")) setup.scale = read_scale(section);
  if (section.has("markers")) setup.markers = read_markers(section.section("markers"));
  if (section.has("shadow_side")) setup.shadow_side = read_shadow_side(section);
  check_sides(section, setup);
  if (section.has("inclination_deg")) setup.inclination = degree * section.number("inclination_deg", -45, 45);
  if (section.has("height_mm")) setup.height = millimetre * section.positive("height_mm", 10'000);
  section.finish();
}

PhotoSetup::Post read_post(YamlSection section) {
  PhotoSetup::Post post{millimetre * section.positive("height_mm", 10'000), pixel(section, "base_px"),
                        pixel(section, "tip_px")};
  if (post.base_px == post.tip_px) section.refuse("tip_px", "must be another point than base_px");
  section.finish();
  return post;
}

PhotoSetup::Sun read_sun(YamlSection section) {
  PhotoSetup::Sun sun;
  try {
    sun.unix_time = parse_utc(section.text("utc"));
  } catch (const Error& error) {
    if (!section.has("utc")) throw;
    section.refuse("utc", "must be a time of UTC, like 2026-06-01T15:30:00Z");
  }
  sun.latitude = degree * section.number("latitude_deg", -90, 90);
  sun.longitude = degree * section.number("longitude_deg", -180, 360);
  sun.north_px = direction(section, "north_px");
  const double elevation = sun_position(sun.unix_time, sun.latitude, sun.longitude).elevation / degree;
  if (elevation < lowest_light || elevation > highest_light)
    section.refuse("utc",
                   fmt::format("when the sun stood at {:.1f} degrees there, must be a time with {:g} to {:g}",
                               elevation, lowest_light, highest_light));
  section.finish();
  return sun;
}

void read_light(YamlSection section, PhotoSetup& setup) {
  const bool angles = section.has("elevation_deg") || section.has("azimuth_deg");
  if (static_cast<int>(angles) + static_cast<int>(section.has("post")) +
          static_cast<int>(section.has("sun")) >
      1)
    section.refuse(section.has("post") ? "post" : "sun",
                   "must be the only form of light: angles, post or sun");
  if (section.has("post")) {
    setup.light = read_post(section.section("post"));
  } else if (section.has("sun")) {
    setup.light = read_sun(section.section("sun"));
  } else {
    PhotoSetup::Angles light;
    light.elevation = degree * section.number("elevation_deg", lowest_light, highest_light);
    if (section.has("azimuth_deg")) light.azimuth = degree * section.number("azimuth_deg", -80, 80);
    setup.light = light;
  }
  section.finish();
}

}  // namespace

PhotoSetup read_photo_setup(const std::string& path, bool scale_needed) {
  YamlSection root = YamlSection::load(path);
  PhotoSetup setup;
  if (root.has("camera")) {
    if (root.is_text("camera"))
      read_camera(
          YamlSection::load((std::filesystem::path(path).parent_path() / root.text("camera")).string()),
          setup);
    else
      read_camera(root.section("camera"), setup);
  }
  if (root.has("straightedge")) read_straightedge(root.section("straightedge"), setup);
  if (root.has("light")) read_light(root.section("light"), setup);
  if (root.has("grain_diameter_mm"))
    setup.grain_diameter = millimetre * root.number("grain_diameter_mm", 0.01, 20);
  if (root.has("wind_px")) setup.wind_px = direction(root, "wind_px");
  root.finish();
  if (scale_needed && setup.scale.empty() && !setup.markers)
    throw Error(path + ": there is no scale, must have straightedge.scale_px_mm or straightedge.markers");
  if (std::holds_alternative<std::monostate>(setup.light))
    throw Error(path + ": there is no light, must have light.elevation_deg, light.post or light.sun");
  return setup;
}

}  // namespace aeolian
