#include "aeolian_core/measure/strip_markers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/measure/tone.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using Corners = std::array<Eigen::Vector2d, 4>;  // upper left, upper right, lower right, lower left

const std::map<std::string, cv::aruco::PREDEFINED_DICTIONARY_NAME>& dictionaries() {
  using namespace cv::aruco;
  static const std::map<std::string, PREDEFINED_DICTIONARY_NAME> all{
      {"DICT_4X4_50", DICT_4X4_50},
      {"DICT_4X4_100", DICT_4X4_100},
      {"DICT_4X4_250", DICT_4X4_250},
      {"DICT_4X4_1000", DICT_4X4_1000},
      {"DICT_5X5_50", DICT_5X5_50},
      {"DICT_5X5_100", DICT_5X5_100},
      {"DICT_5X5_250", DICT_5X5_250},
      {"DICT_5X5_1000", DICT_5X5_1000},
      {"DICT_6X6_50", DICT_6X6_50},
      {"DICT_6X6_100", DICT_6X6_100},
      {"DICT_6X6_250", DICT_6X6_250},
      {"DICT_6X6_1000", DICT_6X6_1000},
      {"DICT_ARUCO_ORIGINAL", DICT_ARUCO_ORIGINAL},
      {"DICT_APRILTAG_16h5", DICT_APRILTAG_16h5},
      {"DICT_APRILTAG_25h9", DICT_APRILTAG_25h9},
      {"DICT_APRILTAG_36h10", DICT_APRILTAG_36h10},
      {"DICT_APRILTAG_36h11", DICT_APRILTAG_36h11}};
  return all;
}

/// The photo in 8 bits, made smaller by a whole factor.
cv::Mat reduced(const Photo& photo, int factor) {
  const cv::Size size(photo.width_px, photo.height_px);
  cv::Mat whole;
  if (photo.white == 255) {
    whole = cv::Mat(size, CV_8U, const_cast<std::uint8_t*>(photo.values8.data()));
  } else {
    cv::Mat(size, CV_16U, const_cast<std::uint16_t*>(photo.values16.data()))
        .convertTo(whole, CV_8U, 255.0 / photo.white);
  }
  if (factor == 1) return whole;
  cv::Mat small;
  cv::resize(whole, small, cv::Size(photo.width_px / factor, photo.height_px / factor), 0, 0, cv::INTER_AREA);
  return small;
}

struct Side {
  Eigen::Vector2d point;
  Eigen::Vector2d direction;
};

/// Where a line across a side, `outward` from inside the black, reaches half of the light between black and
/// white; nothing where the two do not differ clearly.
std::optional<double> half_light(const Tone& tone, const Eigen::Vector2d& at, const Eigen::Vector2d& outward,
                                 double reach) {
  const int n = 2 * static_cast<int>(std::ceil(2 * reach)) + 1;
  const double step = 2 * reach / (n - 1);
  std::vector<float> light(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d p = at + (i * step - reach) * outward;
    light[static_cast<std::size_t>(i)] = tone(p.x(), p.y());
  }
  const auto quarter = static_cast<std::size_t>(n / 4);
  float black = 0;
  float white = 0;
  for (std::size_t i = 0; i <= quarter; ++i) {
    black += light[i] / static_cast<float>(quarter + 1);
    white += light[light.size() - 1 - i] / static_cast<float>(quarter + 1);
  }
  if (!(white > 1.5F * black) || white - black < 0.02F) return {};
  const float half = (black + white) / 2;
  for (std::size_t i = 1; i < light.size(); ++i)
    if (light[i - 1] < half && light[i] >= half)
      return (static_cast<double>(i) - 1 +
              static_cast<double>((half - light[i - 1]) / (light[i] - light[i - 1]))) *
                 step -
             reach;
  return {};
}

/// The side between two corners, through the places of half light.
std::optional<Side> fit_side(const Tone& tone, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                             const Eigen::Vector2d& centre, double reach) {
  const Eigen::Vector2d along = (to - from).normalized();
  Eigen::Vector2d outward(-along.y(), along.x());
  if (outward.dot(from - centre) < 0) outward = -outward;
  const double length = (to - from).norm();
  const int samples = std::clamp(static_cast<int>(length / 2), 8, 60);
  std::vector<Eigen::Vector2d> places;  // along, outward
  for (int i = 0; i < samples; ++i) {
    const double t = length * (0.12 + 0.76 * (i + 0.5) / samples);
    if (const auto out = half_light(tone, from + t * along, outward, reach)) places.emplace_back(t, *out);
  }
  if (places.size() < 6) return {};
  double offset = 0;
  double slope = 0;
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const auto& place : places) {
      const double miss = place.y() - offset - slope * (place.x() - length / 2);
      const double weight = round == 0 ? 1 : 1 / (1 + miss * miss / 0.04);
      const Eigen::Vector2d row(1, place.x() - length / 2);
      normal += weight * row * row.transpose();
      right += weight * place.y() * row;
    }
    const Eigen::Vector2d line = normal.ldlt().solve(right);
    offset = line[0];
    slope = line[1];
  }
  return Side{from + length / 2 * along + offset * outward, (along + slope * outward).normalized()};
}

Eigen::Vector2d crossing(const Side& a, const Side& b) {
  Eigen::Matrix2d directions;
  directions << a.direction, -b.direction;
  return a.point + (directions.inverse() * (b.point - a.point))[0] * a.direction;
}

std::optional<Corners> refined(const Tone& tone, const Corners& corners, int modules) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const auto& corner : corners) centre += corner / 4;
  std::array<Side, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % 4];
    const double module = (to - from).norm() / modules;
    const auto side = fit_side(tone, from, to, centre, std::clamp(0.8 * module, 2.0, 12.0));
    if (!side) return {};
    sides[i] = *side;
  }
  Corners result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = crossing(sides[(i + 3) % 4], sides[i]);
  return result;
}

}  // namespace

std::vector<PlanePoint> find_markers(const Photo& photo, const PhotoSetup::Markers& markers) {
  const auto known = dictionaries().find(markers.dictionary);
  if (known == dictionaries().end())
    throw Error(
        fmt::format("straightedge.markers.dictionary is '{}', must be one of OpenCV's, such as DICT_4X4_50",
                    markers.dictionary));
  const auto dictionary = cv::aruco::getPredefinedDictionary(known->second);
  const int modules = dictionary->markerSize + 2;

  constexpr int enough_px = 1600;  // of a photo's long side, for finding
  const int factor = std::max(1, std::max(photo.width_px, photo.height_px) / enough_px);
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->adaptiveThreshWinSizeMin = 15;
  parameters->adaptiveThreshWinSizeMax = 15;
  parameters->minMarkerPerimeterRate = 0.01;
  std::vector<std::vector<cv::Point2f>> found;
  std::vector<int> ids;
  for (int f = factor; f >= 1 && ids.empty(); f /= 2) {
    cv::aruco::detectMarkers(reduced(photo, f), dictionary, found, ids, parameters);
    for (auto& corners : found)
      for (auto& corner : corners) {
        corner.x = (corner.x + 0.5F) * static_cast<float>(f) - 0.5F;
        corner.y = (corner.y + 0.5F) * static_cast<float>(f) - 0.5F;
      }
  }

  const Tone tone(photo);
  std::vector<PlanePoint> points;
  for (const auto& centre : markers.centres) {
    const auto at = std::find(ids.begin(), ids.end(), centre.id);
    if (at == ids.end()) continue;
    const auto& rough = found[static_cast<std::size_t>(at - ids.begin())];
    Corners corners;
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = {static_cast<double>(rough[i].x), static_cast<double>(rough[i].y)};
    bool clear = true;
    for (int round = 0; round < 2 && clear; ++round) {
      const auto better = refined(tone, corners, modules);
      clear = better.has_value();
      if (clear) corners = *better;
    }
    if (!clear) continue;  // something lies over a side
    const double half = markers.size / 2;
    const std::array<Eigen::Vector2d, 4> offsets{Eigen::Vector2d(-half, half), Eigen::Vector2d(half, half),
                                                 Eigen::Vector2d(half, -half), Eigen::Vector2d(-half, -half)};
    for (std::size_t i = 0; i < 4; ++i) points.push_back({centre.position + offsets[i], corners[i], true});
  }
  if (points.empty())
    throw Error(
        fmt::format("none of the {} markers of {} is seen", markers.centres.size(), markers.dictionary));
  return points;
}

}  // namespace aeolian
