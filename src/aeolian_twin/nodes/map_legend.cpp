#include "aeolian_twin/nodes/map_legend.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace aeolian {
namespace {

using visualization_msgs::Marker;

constexpr int bar_steps = 48;
constexpr double bar_length = 0.6;  // of the map's
constexpr int labels = 3;

std_msgs::ColorRGBA opaque(float red, float green, float blue) {
  std_msgs::ColorRGBA colour;
  colour.r = red;
  colour.g = green;
  colour.b = blue;
  colour.a = 1;
  return colour;
}

geometry_msgs::Point at(double x, double y) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  return point;
}

}  // namespace

std::string value_words(double value, const ValueRange& range, const std::string& unit) {
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  const bool small = unit == "m" && largest < 0.5;
  const double one = small ? 1e-3 : 1;
  const double span = (range.high - range.low) / one;
  // A hundredth of the range at least.
  const int decimals = span > 0 ? std::clamp(2 - static_cast<int>(std::ceil(std::log10(span))), 0, 9) : 1;
  const double steps = std::pow(10, decimals);
  const double rounded = std::round(value / one * steps) / steps + 0.0;  // no -0
  const std::string words = small ? "mm" : unit;
  return fmt::format("{:.{}f}{}{}", rounded, rounded == 0 ? 0 : decimals, words.empty() ? "" : " ", words);
}

/// The height of a line of text [m].
double MapLegend::line() const { return 0.06 * std::min(geometry.length_x(), 2 * geometry.length_y()); }

std::vector<Marker> MapLegend::markers() const {
  std::vector<Marker> result = only_title();
  result[1] = bar();
  for (int i = 0; i < labels; ++i) {
    const double share = static_cast<double>(i) / (labels - 1);
    const double value = look.range.low + share * (look.range.high - look.range.low);
    const double east = geometry.length_x() * (0.5 + bar_length * (share - 0.5));
    result[static_cast<std::size_t>(2 + i)] =
        text("scale", i, value_words(value, look.range, unit), east, -2.1 * line());
  }
  return result;
}

std::vector<Marker> MapLegend::only_title() const {
  std::vector<Marker> result{
      text("title", 0, title, geometry.length_x() / 2, geometry.length_y() + 0.9 * line())};
  result.front().scale.z = 1.15 * line();
  result.push_back(marker("bar", 0, Marker::TRIANGLE_LIST));
  for (int i = 0; i < labels; ++i) result.push_back(marker("scale", i, Marker::TEXT_VIEW_FACING));
  for (std::size_t i = 1; i < result.size(); ++i) result[i].action = Marker::DELETE;
  return result;
}

Marker MapLegend::marker(const std::string& ns, int id, int type) const {
  Marker result;
  result.header = header;
  result.ns = ns;
  result.id = id;
  result.type = type;
  result.action = Marker::ADD;
  result.pose.position.x = geometry.origin_x() + look.offset[0];
  result.pose.position.y = geometry.origin_y() + look.offset[1];
  result.pose.position.z = lowest + look.offset[2];
  result.pose.orientation.w = 1;
  result.scale.x = result.scale.y = result.scale.z = 1;
  result.color = opaque(0.12F, 0.12F, 0.12F);
  return result;
}

Marker MapLegend::text(const std::string& ns, int id, const std::string& words, double east,
                       double north) const {
  Marker result = marker(ns, id, Marker::TEXT_VIEW_FACING);
  result.text = words;
  result.pose.position.x += east;
  result.pose.position.y += north;
  result.scale.z = line();
  return result;
}

Marker MapLegend::bar() const {
  Marker result = marker("bar", 0, Marker::TRIANGLE_LIST);
  const double west = geometry.length_x() * (1 - bar_length) / 2;
  const double step = geometry.length_x() * bar_length / bar_steps;
  const double south = -1.3 * line();
  const double north = -0.6 * line();
  for (int i = 0; i < bar_steps; ++i) {
    const double x0 = west + i * step;
    const double x1 = x0 + step;
    for (const auto& corner :
         {at(x0, south), at(x1, south), at(x1, north), at(x0, south), at(x1, north), at(x0, north)})
      result.points.push_back(corner);
    const Rgb rgb = colour(look.palette, (i + 0.5) / bar_steps);
    const auto channel = [&](std::size_t c) { return static_cast<float>(rgb[c]) / 255.0F; };
    result.colors.insert(result.colors.end(), 6, opaque(channel(0), channel(1), channel(2)));
  }
  return result;
}

}  // namespace aeolian
