#include "aeolian_twin/nodes/drawn_wind.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace aeolian {
namespace {

using Eigen::Vector2d;
using visualization_msgs::Marker;

constexpr int arrows = 24;          ///< along the longer side of the map
constexpr double lift = 0.008;      ///< over the mesh, of that side
constexpr double longest = 0.9;     ///< arrow, of their spacing
constexpr double head = 0.35;       ///< of an arrow
constexpr double head_angle = 2.6;  ///< from its shaft [rad]
constexpr double between = 0.5;     ///< streamlines, of the spacing of arrows
constexpr double shortest = 2;      ///< streamline, of the same
constexpr double stride = 0.2;      ///< along a streamline, of the distance between them

/// The wind at a place of the map, as a vector of its friction velocity; zero where there is none.
class WindAt {
 public:
  explicit WindAt(const WindField& wind)
      : uniform_(wind.friction_velocity * Vector2d(std::cos(wind.direction), std::sin(wind.direction))) {
    if (!wind.cells.has("friction_velocity")) return;
    grid_ = wind.cells.geometry();
    speed_ = &wind.cells.layer("friction_velocity");
    direction_ = &wind.cells.layer("direction");
  }
  Vector2d operator()(const Vector2d& place) const {
    if (!speed_) return uniform_;
    const auto cell = grid_.find(place.x(), place.y());
    if (!cell) return Vector2d::Zero();
    const std::size_t i = grid_.index(*cell);
    const auto speed = static_cast<double>((*speed_)[i]);
    const auto angle = static_cast<double>((*direction_)[i]);
    if (!std::isfinite(speed) || !std::isfinite(angle)) return Vector2d::Zero();
    return speed * Vector2d(std::cos(angle), std::sin(angle));
  }

 private:
  Vector2d uniform_;
  GridGeometry grid_;
  const HeightMap::Layer* speed_ = nullptr;
  const HeightMap::Layer* direction_ = nullptr;
};

class Drawing {
 public:
  Drawing(const WindField& wind, const DrawnLayers& layers, const SurfaceLook& look,
          const std_msgs::Header& header)
      : wind_(wind),
        layers_(layers),
        grid_(layers.geometry),
        look_(look),
        header_(header),
        side_(std::max(grid_.length_x(), grid_.length_y())),
        spacing_(side_ / arrows),
        lowest_(lowest_height(layers.heights)) {}

  Marker arrow_lines() const {
    Marker lines = marker("arrows");  // a blue that is seen on dark and on pale sand
    lines.color.r = 0;
    lines.color.g = 0.55F;
    lines.color.b = 1;
    lines.color.a = 1;
    std::vector<Vector2d> places;
    double greatest = 0;
    for (double y = spacing_ / 2; y < grid_.length_y(); y += spacing_)
      for (double x = spacing_ / 2; x < grid_.length_x(); x += spacing_) {
        const Vector2d place(grid_.origin_x() + x, grid_.origin_y() + y);
        const double speed = wind_(place).norm();
        if (!(speed > 0) || !is_known(place)) continue;
        places.push_back(place);
        greatest = std::max(greatest, speed);
      }
    for (const Vector2d& place : places) {
      const Vector2d along = longest * spacing_ / greatest * wind_(place);
      const Vector2d tip = place + 0.5 * along;
      add(lines, place - 0.5 * along, tip);
      for (const double angle : {head_angle, -head_angle}) {
        const Vector2d back(std::cos(angle) * along.x() - std::sin(angle) * along.y(),
                            std::sin(angle) * along.x() + std::cos(angle) * along.y());
        add(lines, tip, tip + head * back);
      }
    }
    return finished(lines);
  }

  Marker streamlines() {
    Marker lines = marker("streamlines");
    lines.color.r = 0.6F;
    lines.color.g = 0.82F;
    lines.color.b = 1;
    lines.color.a = 0.9F;
    const double step = between * spacing_;
    lanes_x_ = static_cast<int>(std::ceil(grid_.length_x() / step));
    lanes_y_ = static_cast<int>(std::ceil(grid_.length_y() / step));
    owner_.assign(static_cast<std::size_t>(lanes_x_) * static_cast<std::size_t>(lanes_y_), 0);
    for (std::size_t lane = 0; lane < owner_.size(); ++lane) {
      if (owner_[lane] != 0) continue;
      const auto nx = static_cast<std::size_t>(lanes_x_);
      const Vector2d seed(grid_.origin_x() + (static_cast<double>(lane % nx) + 0.5) * step,
                          grid_.origin_y() + (static_cast<double>(lane / nx) + 0.5) * step);
      const auto id = static_cast<std::int32_t>(lane) + 1;
      std::vector<Vector2d> line = traced(seed, -1, id);
      if (line.empty()) continue;
      std::reverse(line.begin(), line.end());
      const std::vector<Vector2d> downwind = traced(seed, 1, id);
      line.insert(line.end(), downwind.begin() + 1, downwind.end());
      if (static_cast<double>(line.size()) * stride * step < shortest * spacing_) continue;
      for (std::size_t i = 1; i < line.size(); ++i) add(lines, line[i - 1], line[i]);
    }
    return finished(lines);
  }

 private:
  /// From a seed along the wind or against it, until another line's lane or where there is no wind.
  std::vector<Vector2d> traced(const Vector2d& seed, double sign, std::int32_t id) {
    const double step = stride * between * spacing_;
    const auto longest_line = static_cast<std::size_t>(2 * side_ / step);
    std::vector<Vector2d> line;
    for (Vector2d place = seed; line.size() < longest_line;) {
      const Vector2d wind = wind_(place);
      if (!(wind.norm() > 0) || !is_known(place)) break;
      std::int32_t& owner = owner_of(place);
      if (owner != 0 && owner != id) break;
      owner = id;
      line.push_back(place);
      const Vector2d half = wind_(place + 0.5 * sign * step * wind.normalized());
      if (!(half.norm() > 0)) break;
      place += sign * step * half.normalized();
    }
    return line;
  }

  std::int32_t& owner_of(const Vector2d& place) {
    const double step = between * spacing_;
    const int x = std::clamp(static_cast<int>((place.x() - grid_.origin_x()) / step), 0, lanes_x_ - 1);
    const int y = std::clamp(static_cast<int>((place.y() - grid_.origin_y()) / step), 0, lanes_y_ - 1);
    return owner_[static_cast<std::size_t>(y) * static_cast<std::size_t>(lanes_x_) +
                  static_cast<std::size_t>(x)];
  }

  bool is_known(const Vector2d& place) const {
    const auto cell = grid_.find(place.x(), place.y());
    return cell && std::isfinite(layers_.heights[grid_.index(*cell)]);
  }

  void add(Marker& lines, const Vector2d& from, const Vector2d& to) const {
    for (const Vector2d& place : {from, to}) {
      geometry_msgs::Point& point = lines.points.emplace_back();
      point.x = place.x() - grid_.origin_x();
      point.y = place.y() - grid_.origin_y();
      const int x = std::clamp(static_cast<int>(std::floor(point.x / grid_.cell())), 0, grid_.nx() - 1);
      const int y = std::clamp(static_cast<int>(std::floor(point.y / grid_.cell())), 0, grid_.ny() - 1);
      const float height = layers_.heights[grid_.index(x, y)];
      if (std::isfinite(height)) point.z = (static_cast<double>(height) - lowest_) * look_.exaggeration;
    }
  }

  Marker marker(const std::string& ns) const {
    Marker lines;
    lines.header = header_;
    lines.ns = ns;
    lines.type = Marker::LINE_LIST;
    lines.pose.position.x = grid_.origin_x() + look_.offset[0];
    lines.pose.position.y = grid_.origin_y() + look_.offset[1];
    lines.pose.position.z = lowest_ + look_.offset[2] + lift * side_;
    lines.pose.orientation.w = 1;
    lines.scale.x = 0.0025 * side_;
    return lines;
  }
  static Marker finished(Marker lines) {
    lines.action = lines.points.empty() ? Marker::DELETE : Marker::ADD;
    return lines;
  }

  WindAt wind_;
  const DrawnLayers& layers_;
  const GridGeometry& grid_;
  const SurfaceLook& look_;
  const std_msgs::Header& header_;
  double side_;
  double spacing_;
  double lowest_;
  int lanes_x_ = 0;
  int lanes_y_ = 0;
  std::vector<std::int32_t> owner_;  ///< line that runs through a lane; zero: none yet
};

}  // namespace

visualization_msgs::MarkerArray draw_wind(const WindField& wind, const DrawnLayers& layers,
                                          const SurfaceLook& look, const std_msgs::Header& header) {
  Drawing drawing(wind, layers, look, header);
  visualization_msgs::MarkerArray result;
  result.markers.push_back(drawing.arrow_lines());
  result.markers.push_back(drawing.streamlines());
  result.markers.back().scale.x *= 0.6;
  return result;
}

}  // namespace aeolian
