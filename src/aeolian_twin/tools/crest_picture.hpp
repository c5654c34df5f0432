#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_twin/photo/canvas.hpp"

namespace aeolian {

/// What a picture of crests is drawn with.
namespace crest_ink {
constexpr Ink crest{0.05, 0.25, 0.65};
constexpr Ink termination{0.85, 0.1, 0.1};
constexpr Ink junction{0.95, 0.55, 0.0};
constexpr Ink motion{0.0, 0.4, 0.15};
constexpr Ink text{0.1, 0.1, 0.1};
constexpr Ink paper{1, 1, 1};
}  // namespace crest_ink

inline std::vector<Eigen::Vector2d> circle(const Eigen::Vector2d& middle, double radius) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 24; ++i)
    points.push_back(middle + radius * Eigen::Vector2d(std::cos(i * M_PI / 12), std::sin(i * M_PI / 12)));
  return points;
}

/// The shaded map with its crests, their ends and their motion, as PNG.
class CrestPicture {
 public:
  CrestPicture(const GridGeometry& geometry, const HeightMap::Layer& elevation, const TrackedMap& map)
      : geometry_(geometry), scale_(std::clamp(1000.0 / std::max(geometry.nx(), geometry.ny()), 0.1, 16.0)) {
    const auto colours = shaded_colours(geometry, elevation, Palette::sand,
                                        display_range(elevation, Palette::sand), nullptr, 2);
    cv::Mat shaded(geometry.ny(), geometry.nx(), CV_8UC3);
    for (int y = 0; y < geometry.ny(); ++y)
      for (int x = 0; x < geometry.nx(); ++x) {
        const Rgb& c = colours[geometry.index(x, y)];
        shaded.at<cv::Vec3b>(geometry.ny() - 1 - y, x) = {c[2], c[1], c[0]};
      }
    cv::resize(shaded, shaded, {}, scale_, scale_, scale_ < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    cv::cvtColor(shaded, shaded, cv::COLOR_BGR2BGRA);
    const int width = std::max(shaded.cols, least_width);
    picture_ = cv::Mat(shaded.rows + margin, width, CV_8UC4, cv::Scalar(255, 255, 255, 255));
    shaded.copyTo(picture_(cv::Rect(0, 0, shaded.cols, shaded.rows)));
    draw(map, shaded.rows);
  }

  void write(const std::string& path) const {
    write_atomically(path, [&](const std::string& temporary) {
      if (!cv::imwrite(temporary, picture_)) throw Error("cannot write '" + path + "'");
    });
  }

 private:
  static constexpr int margin = 58;  ///< below the map, for words [px]
  static constexpr int least_width = 640;

  Eigen::Vector2d pixel(const Eigen::Vector2d& place) const {
    return {(place.x() - geometry_.origin_x()) / geometry_.cell() - 0.5,
            geometry_.ny() - 0.5 - (place.y() - geometry_.origin_y()) / geometry_.cell()};
  }

  /// The motion of a crest; the fastest are three quarters of a wavelength long.
  void arrow(Canvas& canvas, const Eigen::Vector2d& from, double direction, double length) const {
    const Eigen::Vector2d ahead(std::cos(direction), -std::sin(direction));
    const Eigen::Vector2d start = pixel(from);
    const Eigen::Vector2d tip = start + length / geometry_.cell() * ahead;
    canvas.line({start, tip}, 3, crest_ink::motion);
    canvas.pointer(tip, -ahead, 8, crest_ink::motion);
  }

  void draw(const TrackedMap& map, int below) {
    Canvas canvas(picture_, scale_);
    for (const CrestLine& crest : map.found.crests) {
      std::vector<Eigen::Vector2d> line;
      for (const Eigen::Vector2d& point : crest.points) line.push_back(pixel(point));
      canvas.line(line, 1.8, crest_ink::crest);
    }
    double fastest = 0;
    for (const CrestMotion& motion : map.motions)
      if (std::isfinite(motion.speed.value)) fastest = std::max(fastest, std::abs(motion.speed.value));
    const double wavelength = map.found.relief.pattern.wavelength;
    for (std::size_t c = 0; c < map.motions.size(); ++c) {
      const CrestMotion& motion = map.motions[c];
      const auto& points = map.found.crests[c].points;
      if (fastest > 0 && std::isfinite(motion.speed.value))
        arrow(canvas, points[points.size() / 2], motion.direction,
              0.75 * wavelength * std::abs(motion.speed.value) / fastest);
    }
    for (const RippleDefect& defect : map.found.defects)
      canvas.line(circle(pixel(defect.place), 7 / scale_), 3,
                  defect.kind == CrestEnd::junction ? crest_ink::junction : crest_ink::termination, 0, true);
    words(canvas, map, below);
  }

  void words(Canvas& canvas, const TrackedMap& map, int below) const {
    const RippleField& f = map.field;
    const std::string figures =
        f.crests == 0 ? fmt::format("{:g} s: no ripples that stand out of the noise", map.time)
                      : fmt::format("{:g} s: wavelength {:.1f} mm, height {:.2f} mm, index {:.1f}{}",
                                    map.time, 1e3 * f.wavelength.value, 1e3 * f.height.value, f.index.value,
                                    std::isfinite(map.celerity.value)
                                        ? fmt::format(", {:.2f} mm/min", 6e4 * map.celerity.value)
                                        : "");
    canvas.text(10, below + 21, 15, true, crest_ink::text, figures);
    double x = 10;
    const double y = below + 44;
    const auto item = [&](const std::string& name, const Ink& ink, bool ring) {
      if (ring)
        canvas.line(circle(canvas.pixel_at(x + 10, y - 5), 6 / scale_), 3, ink, 0, true);
      else
        canvas.stroke(x, y - 5, x + 20, y - 5, 3, ink);
      canvas.text(x + 26, y, 13, false, crest_ink::text, name);
      x += 44 + canvas.text_width(13, false, name);
    };
    item("crest", crest_ink::crest, false);
    item("it ends", crest_ink::termination, true);
    item("it runs into another", crest_ink::junction, true);
    item("motion", crest_ink::motion, false);
    const double metres = geometry_.length_x();
    const double bar = std::pow(10, std::floor(std::log10(0.3 * metres)));
    const double length = bar / geometry_.cell() * scale_;
    canvas.stroke(x, y - 5, x + length, y - 5, 4, crest_ink::text);
    canvas.text(x + length + 6, y, 13, false, crest_ink::text, fmt::format("{:g} m", bar));
  }

  const GridGeometry& geometry_;
  double scale_;
  cv::Mat picture_;
};

}  // namespace aeolian
