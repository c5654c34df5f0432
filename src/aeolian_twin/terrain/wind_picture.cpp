#include "aeolian_twin/terrain/wind_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/photo/canvas.hpp"

namespace aeolian {
namespace {

constexpr Ink black{0.1, 0.1, 0.1};
constexpr Ink halo{1, 1, 1, 0.55};
const cv::Vec3b calm(150, 150, 150);
constexpr int longest_side = 1000;  ///< of the map [px]
constexpr int margin = 76;          ///< below the map, for words [px]
constexpr int least_width = 720;
constexpr double spacing = 44;       ///< of arrows [px]
constexpr double arrow_length = 34;  ///< of the wind of the surroundings [px]
constexpr double least_range = 0.05;

class SpeedUpPicture {
 public:
  explicit SpeedUpPicture(const TerrainWindRun& run)
      : run_(run),
        g_(run.map.geometry()),
        values_(speed_up(run)),
        scale_(std::clamp(static_cast<double>(longest_side) / std::max(g_.nx(), g_.ny()), 0.05, 40.0)) {
    HeightMap::Layer attached = values_;  // separated air has a colour of its own
    if (run_.field.cells.has("separated"))
      for (std::size_t i = 0; i < attached.size(); ++i)
        if (run_.field.cells.layer("separated")[i] > 0) attached[i] = HeightMap::unknown;
    const ValueRange shown = display_range(attached, Palette::diverging);
    range_ = std::max({least_range, shown.high, -shown.low});
    paint();
    Canvas canvas(picture_, scale_);
    arrows(canvas);
    words(canvas);
  }
  void write(const std::string& path) const {
    write_atomically(path, [&](const std::string& temporary) {
      if (!cv::imwrite(temporary, picture_)) throw Error("cannot write '" + path + "'");
    });
  }

 private:
  void paint() {
    const HeightMap::Layer& elevation = run_.map.layer(layer::elevation);
    const auto [low, high] = std::minmax_element(elevation.begin(), elevation.end(), [](float a, float b) {
      return (std::isfinite(a) ? a : INFINITY) < (std::isfinite(b) ? b : INFINITY);
    });
    // Gentle relief is exaggerated until it can be seen.
    const double range = std::isfinite(*high) && std::isfinite(*low) ? static_cast<double>(*high - *low) : 0;
    const double length = g_.cell() * std::max(g_.nx(), g_.ny());
    const double exaggeration = range > 0 ? std::clamp(0.05 * length / range, 1.0, 50.0) : 1;
    const auto colours =
        shaded_colours(g_, values_, Palette::diverging, {-range_, range_}, &elevation, exaggeration);
    cv::Mat cells(g_.ny(), g_.nx(), CV_8UC3);
    const bool relief = run_.field.cells.has("separated");
    for (int y = 0; y < g_.ny(); ++y)
      for (int x = 0; x < g_.nx(); ++x) {
        const std::size_t i = g_.index(x, y);
        const bool separated = relief && run_.field.cells.layer("separated")[i] > 0;
        const Rgb& c = colours[i];
        cells.at<cv::Vec3b>(g_.ny() - 1 - y, x) = separated ? calm : cv::Vec3b(c[2], c[1], c[0]);
      }
    cv::resize(cells, cells, {}, scale_, scale_, scale_ < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    cv::cvtColor(cells, cells, cv::COLOR_BGR2BGRA);
    below_ = cells.rows;
    picture_ = cv::Mat(cells.rows + margin, std::max(cells.cols, least_width), CV_8UC4,
                       cv::Scalar(255, 255, 255, 255));
    cells.copyTo(picture_(cv::Rect(0, 0, cells.cols, cells.rows)));
  }

  /// Place of a point of the map in the picture [cells, from the top].
  Eigen::Vector2d pixel(const Eigen::Vector2d& p) const {
    return {(p.x() - g_.origin_x()) / g_.cell() - 0.5, g_.ny() - 0.5 - (p.y() - g_.origin_y()) / g_.cell()};
  }

  /// Unit vector of the wind at the ground times its friction velocity over that of the surroundings.
  Eigen::Vector2d wind(const Eigen::Vector2d& p) const {
    const HeightMap& cells = run_.field.cells;
    const auto cell = g_.find(p.x(), p.y());
    if (!cell) return {0, 0};
    if (!cells.has("direction")) return {std::cos(run_.field.direction), std::sin(run_.field.direction)};
    const std::size_t i = g_.index(*cell);
    const double direction = static_cast<double>(cells.layer("direction")[i]);
    const double strength = static_cast<double>(values_[i]) + 1;
    if (!std::isfinite(strength) || !std::isfinite(direction)) return {0, 0};
    return strength * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }

  void arrows(Canvas& canvas) const {
    if (!(run_.field.friction_velocity > 0)) return;
    constexpr int steps = 24;
    const double step = arrow_length / scale_ * g_.cell() / steps;
    for (double py = 0.5 * spacing; py < below_; py += spacing)
      for (double px = 0.5 * spacing; px < g_.nx() * scale_; px += spacing) {
        Eigen::Vector2d p(g_.origin_x() + px / scale_ * g_.cell(),
                          g_.origin_y() + (g_.ny() - py / scale_) * g_.cell());
        std::vector<Eigen::Vector2d> line{pixel(p)};
        Eigen::Vector2d last(0, 0);
        for (int n = 0; n < steps; ++n) {
          const Eigen::Vector2d u = wind(p);
          if (u.norm() < 0.05) break;
          last = u.normalized();
          p += step * u;
          line.push_back(pixel(p));
        }
        if (line.size() < 4) continue;
        canvas.line(line, 3.2, halo);
        canvas.line(line, 1.4, black);
        canvas.pointer(line.back(), {-last.x(), last.y()}, 6, black);
      }
  }

  void words(Canvas& canvas) const {
    const WindField& f = run_.field;
    canvas.text(10, below_ + 22, 15, true, black,
                fmt::format("{:g} m/s at {:g} m: friction velocity {:.3f} m/s, from {:.0f}° — {}",
                            run_.anemometer.speed, run_.anemometer.height, f.friction_velocity,
                            meteorological_from_direction(f.direction), f.model));
    double x = 10;
    const double y = below_ + 52;
    canvas.text(x, y, 13, false, black, "friction velocity at the ground:");
    x += 14 + canvas.text_width(13, false, "friction velocity at the ground:");
    const std::string low = fmt::format("{:+.0f} %", -100 * range_);
    canvas.text(x, y, 13, false, black, low);
    x += 8 + canvas.text_width(13, false, low);
    constexpr int bar = 140;
    for (int i = 0; i < bar; ++i) {
      const Rgb c = colour(Palette::diverging, (i + 0.5) / bar);
      canvas.box(x + i, y - 12, 1.5, 14, {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0});
    }
    x += bar + 8;
    const std::string high = fmt::format("{:+.0f} %", 100 * range_);
    canvas.text(x, y, 13, false, black, high);
    x += 24 + canvas.text_width(13, false, high);
    if (f.cells.has("separated")) {
      canvas.box(x, y - 12, 20, 14, {calm[2] / 255.0, calm[1] / 255.0, calm[0] / 255.0});
      canvas.text(x + 26, y, 13, false, black, "separated air");
      x += 50 + canvas.text_width(13, false, "separated air");
    }
    const double metres = std::pow(10, std::floor(std::log10(0.3 * g_.length_x())));
    const double length = metres / g_.cell() * scale_;
    canvas.stroke(x, y - 5, x + length, y - 5, 4, black);
    canvas.text(x + length + 6, y, 13, false, black, fmt::format("{:g} m", metres));
  }

  const TerrainWindRun& run_;
  const GridGeometry& g_;
  HeightMap::Layer values_;
  double scale_;
  double range_ = 0;
  int below_ = 0;
  cv::Mat picture_;
};

}  // namespace

void draw_speed_up(const TerrainWindRun& run, const std::string& folder) {
  SpeedUpPicture(run).write(folder + "/speed_up.png");
}

}  // namespace aeolian
