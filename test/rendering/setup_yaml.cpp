#include "setup_yaml.hpp"

#include <cmath>
#include <ctime>

#include <fmt/format.h>

namespace aeolian {

namespace {

double mm(double metres) { return 1000 * metres; }
double degrees(double radians) { return radians * 180 / M_PI; }
std::string pixel(const Eigen::Vector2d& p) { return fmt::format("[{:.4f}, {:.4f}]", p.x(), p.y()); }

std::string camera_yaml(const CameraModel& c) {
  const auto& k = c.distortion;
  const bool rational = k[5] != 0 || k[6] != 0 || k[7] != 0;
  std::string text = fmt::format(
      "camera:\n  image_width: {}\n  image_height: {}\n"
      "  camera_matrix: [{:.9g}, 0, {:.9g}, 0, {:.9g}, {:.9g}, 0, 0, 1]\n"
      "  distortion_model: {}\n  distortion_coefficients: [",
      c.width_px, c.height_px, c.fx, c.cx, c.fy, c.cy, rational ? "rational_polynomial" : "plumb_bob");
  for (std::size_t i = 0; i < (rational ? 8 : 5); ++i)
    text += fmt::format("{}{:.9g}", i > 0 ? ", " : "", k[i]);
  return text + "]\n";
}

std::string straightedge_yaml(const PhotoSetup& setup) {
  std::string text = "straightedge:\n";
  if (!setup.line_px.empty()) {
    text += "  line_px:\n";
    for (const Eigen::Vector2d& p : setup.line_px) text += "    - " + pixel(p) + "\n";
  }
  if (!setup.scale.empty()) {
    text += "  scale_px_mm:\n";
    for (const PhotoSetup::ScaleMark& mark : setup.scale) {
      text += fmt::format("    - [{:.4f}, {:.4f}, {:.6g}", mark.pixel.x(), mark.pixel.y(), mm(mark.x));
      text += mark.y ? fmt::format(", {:.6g}]\n", mm(*mark.y)) : "]\n";
    }
  }
  if (setup.markers) {
    text += fmt::format("  markers:\n    dictionary: {}\n    size_mm: {:.9g}\n    centres_mm:\n",
                        setup.markers->dictionary, mm(setup.markers->size));
    for (const PhotoSetup::Markers::Centre& centre : setup.markers->centres) {
      text += fmt::format("      - [{}, {:.9g}, {:.9g}]\n", centre.id, mm(centre.position.x()),
                          mm(centre.position.y()));
    }
  }
  text += fmt::format("  inclination_deg: {:.9g}\n", degrees(setup.inclination));
  if (setup.height) text += fmt::format("  height_mm: {:.9g}\n", mm(*setup.height));
  return text;
}

std::string utc(double unix_time) {
  const auto seconds = static_cast<std::time_t>(std::llround(unix_time));
  std::tm time{};
  gmtime_r(&seconds, &time);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &time);
  return text;
}

std::string light_yaml(const PhotoSetup& setup) {
  if (const auto* angles = std::get_if<PhotoSetup::Angles>(&setup.light)) {
    return fmt::format("light: {{elevation_deg: {:.9g}, azimuth_deg: {:.9g}}}\n", degrees(angles->elevation),
                       degrees(angles->azimuth));
  }
  if (const auto* post = std::get_if<PhotoSetup::Post>(&setup.light)) {
    return fmt::format("light:\n  post: {{height_mm: {:.9g}, base_px: {}, tip_px: {}}}\n", mm(post->height),
                       pixel(post->base_px), pixel(post->tip_px));
  }
  if (const auto* sun = std::get_if<PhotoSetup::Sun>(&setup.light)) {
    return fmt::format(
        "light:\n  sun: {{utc: \"{}\", latitude_deg: {:.9g}, longitude_deg: {:.9g}, north_px: {}}}\n",
        utc(sun->unix_time), degrees(sun->latitude), degrees(sun->longitude), pixel(sun->north_px));
  }
  return "";
}

}  // namespace

std::string setup_yaml(const PhotoSetup& setup) {
  std::string text;
  if (setup.camera) text += camera_yaml(*setup.camera);
  text += straightedge_yaml(setup) + light_yaml(setup);
  if (setup.grain_diameter) text += fmt::format("grain_diameter_mm: {:.9g}\n", mm(*setup.grain_diameter));
  if (setup.wind_px) text += "wind_px: " + pixel(*setup.wind_px) + "\n";
  return text;
}

}  // namespace aeolian
