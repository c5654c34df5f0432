#include "bar_face.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <opencv2/aruco.hpp>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

namespace {

cv::Ptr<cv::aruco::Dictionary> dictionary_called(const std::string& name) {
  static const std::map<std::string, int> names{{"DICT_4X4_50", cv::aruco::DICT_4X4_50},
                                                {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
                                                {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
                                                {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
                                                {"DICT_APRILTAG_16h5", cv::aruco::DICT_APRILTAG_16h5},
                                                {"DICT_APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11}};
  const auto found = names.find(name);
  if (found == names.end()) throw Error("scene: marker dictionary " + name + ": not one that can be drawn");
  return cv::aruco::getPredefinedDictionary(found->second);
}

}  // namespace

BarFace::BarFace(const ShadowScene& scene) : ticks_(scene.ticks) {
  const auto by_x = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() < b.x(); };
  std::sort(ticks_.begin(), ticks_.end(), by_x);
  if (!scene.markers) return;
  size_ = scene.markers->size;
  const cv::Ptr<cv::aruco::Dictionary> dictionary = dictionary_called(scene.markers->dictionary);
  const int modules = dictionary->markerSize + 2;
  for (const PhotoSetup::Markers::Centre& centre : scene.markers->centres) {
    Printed printed;
    printed.corner = centre.position - Eigen::Vector2d::Constant(size_ / 2);
    dictionary->drawMarker(centre.id, modules, printed.modules, 1);
    printed_.push_back(printed);
    strip_.extend(centre.position);
  }
  std::sort(printed_.begin(), printed_.end(),
            [](const Printed& a, const Printed& b) { return a.corner.x() < b.corner.x(); });
  const Eigen::Vector2d border = Eigen::Vector2d::Constant(size_ / 2 * 1.33);  // one module of white around
  strip_.min() -= border;
  strip_.max() += border;
}

double BarFace::albedo(const Eigen::Vector2d& point) const {
  if (!ticks_.empty()) {
    const auto first = std::lower_bound(ticks_.begin(), ticks_.end(), point.x() - tick_radius,
                                        [](const Eigen::Vector2d& tick, double x) { return tick.x() < x; });
    for (auto tick = first; tick != ticks_.end() && tick->x() <= point.x() + tick_radius; ++tick) {
      if ((*tick - point).squaredNorm() < tick_radius * tick_radius) return ink;
    }
  }
  if (printed_.empty() || !strip_.contains(point)) return metal;
  auto next = std::upper_bound(printed_.begin(), printed_.end(), point.x(),
                               [](double x, const Printed& p) { return x < p.corner.x(); });
  if (next == printed_.begin()) return paper;
  const Printed& marker = *--next;
  const Eigen::Vector2d at = (point - marker.corner) / size_;
  if (at.x() >= 1 || at.y() < 0 || at.y() >= 1) return paper;
  const int modules = marker.modules.rows;
  const int row = std::min(static_cast<int>((1 - at.y()) * modules), modules - 1);
  return marker.modules.at<std::uint8_t>(row, static_cast<int>(at.x() * modules)) > 0 ? paper : ink;
}

bool BarFace::plain(const Eigen::Vector2d& point, double reach) const {
  const auto next_tick = std::lower_bound(ticks_.begin(), ticks_.end(), point.x() - tick_radius - reach,
                                          [](const Eigen::Vector2d& tick, double x) { return tick.x() < x; });
  if (next_tick != ticks_.end() && next_tick->x() < point.x() + tick_radius + reach) return false;
  if (printed_.empty()) return true;
  if ((point - strip_.min()).cwiseAbs().minCoeff() < reach) return false;
  if ((point - strip_.max()).cwiseAbs().minCoeff() < reach) return false;
  if (!strip_.contains(point)) return true;
  const auto next = std::upper_bound(printed_.begin(), printed_.end(), point.x(),
                                     [](double x, const Printed& p) { return x < p.corner.x(); });
  const auto near_line = [&](const Printed& marker) {
    const double module = size_ / marker.modules.rows;
    const Eigen::Vector2d at = (point - marker.corner) / module;
    if ((at.array() < -0.5).any() || (at.array() > marker.modules.rows + 0.5).any()) return false;
    const Eigen::Vector2d line{std::round(at.x()), std::round(at.y())};
    return (at - line).cwiseAbs().minCoeff() * module < reach;
  };
  if (next != printed_.end() && near_line(*next)) return false;
  return next == printed_.begin() || !near_line(*std::prev(next));
}

}  // namespace aeolian
