#include "aeolian_core/surface/preview.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/round_length.hpp"

namespace aeolian {
namespace {

const cv::Scalar paper(255, 255, 255);
const cv::Scalar ink(50, 45, 40);
constexpr int margin = 24;
constexpr int text_height = 14;
constexpr int bar_width = 18;
constexpr int bar_column = 120;  ///< colour bar with its labels
constexpr int foot = 52;         ///< scale bar with its label
constexpr int title_line = 34;
constexpr int shortest_map = 160;  ///< room for the colour bar's labels

cv::Vec3b to_pixel(const Rgb& c) { return {c[2], c[1], c[0]}; }

enum class Align { left, centre, right };

void draw_text(cv::Mat& picture, const std::string& text, cv::Point at, Align align = Align::left,
               double size = 0.46) {
  const int width = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, nullptr).width;
  if (align == Align::centre) at.x -= width / 2;
  if (align == Align::right) at.x -= width;
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, ink, 1, cv::LINE_AA);
}

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals,
                std::abs(value) < 0.5 * std::pow(10, -decimals) ? 0.0 : value);
  return text;
}

/// How the values of a layer are written: shown = value * factor.
struct Unit {
  const char* name = "";
  double factor = 1;
};

Unit unit_of(const std::string& name, const ValueRange& range) {
  if (name == layer::age) return {"s", 1};
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  if (name == layer::variance) return largest < 1e-3 ? Unit{"mm^2", 1e6} : Unit{"m^2", 1};
  for (const char* length : {"elevation", "ground", "difference", "displacement"})
    if (name.find(length) != std::string::npos) return largest < 1 ? Unit{"mm", 1e3} : Unit{"m", 1};
  return {};
}

/// Where the parts of the picture lie [px].
struct Layout {
  double scale;  ///< of a cell
  cv::Rect map;
  cv::Size picture;
};

Layout layout_for(const GridGeometry& geometry, const PreviewOptions& options) {
  Layout layout{};
  const double fit = static_cast<double>(options.width_px) / std::max(geometry.nx(), geometry.ny());
  layout.scale = fit >= 1 ? std::floor(fit) : fit;
  const auto pixels = [&](int cells) {
    return std::max(1, static_cast<int>(std::lround(cells * layout.scale)));
  };
  const int top = margin + (options.title.empty() ? 0 : title_line);
  layout.map = {margin, top, pixels(geometry.nx()), pixels(geometry.ny())};
  layout.picture = {std::max(layout.map.width, shortest_map) + 2 * margin + bar_column,
                    top + std::max(layout.map.height, shortest_map) + foot + margin};
  return layout;
}

cv::Mat map_image(const HeightMap& map, const PreviewOptions& options, const ValueRange& range,
                  const cv::Rect& place) {
  const GridGeometry& geometry = map.geometry();
  const HeightMap::Layer& values = map.layer(options.layer);
  const double exaggeration = options.relief ? options.exaggeration : 0;
  const std::vector<Rgb> colours =
      shaded_colours(geometry, values, options.palette, range, nullptr, exaggeration);
  cv::Mat cells(geometry.ny(), geometry.nx(), CV_8UC3);
  cv::Mat unknown(geometry.ny(), geometry.nx(), CV_8UC1);
  for (int y = 0; y < geometry.ny(); ++y)
    for (int x = 0; x < geometry.nx(); ++x) {
      const std::size_t i = geometry.index(x, y);
      const int row = geometry.ny() - 1 - y;
      cells.at<cv::Vec3b>(row, x) = to_pixel(colours[i]);
      unknown.at<std::uint8_t>(row, x) = std::isfinite(values[i]) ? 0 : 1;
    }
  const bool shrink = place.width < geometry.nx();
  cv::Mat image;
  cv::resize(cells, image, place.size(), 0, 0, shrink ? cv::INTER_AREA : cv::INTER_NEAREST);
  cv::resize(unknown, unknown, place.size(), 0, 0, cv::INTER_NEAREST);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (unknown.at<std::uint8_t>(y, x) != 0)
        image.at<cv::Vec3b>(y, x) = (x + y) % 8 < 2 ? cv::Vec3b(168, 168, 168) : cv::Vec3b(222, 222, 222);
  return image;
}

void draw_colour_bar(cv::Mat& picture, const cv::Rect& bar, const PreviewOptions& options,
                     const ValueRange& range) {
  for (int y = 0; y < bar.height; ++y) {
    const double share = bar.height > 1 ? 1 - y / (bar.height - 1.0) : 0.5;
    picture(cv::Rect(bar.x, bar.y + y, bar.width, 1)) = cv::Scalar(to_pixel(colour(options.palette, share)));
  }
  cv::rectangle(picture, bar, ink, 1);
  const Unit unit = unit_of(options.layer, range);
  const double low = range.low * unit.factor;
  const double high = range.high * unit.factor;
  const int label_x = bar.x + bar.width + 9;
  if (!(high > low)) {
    char text[64];
    std::snprintf(text, sizeof(text), "%.4g", low);
    draw_text(picture, text, {label_x, bar.y + bar.height / 2 + 5});
  } else {
    const double step = round_below((high - low) / std::clamp(bar.height / 60, 2, 8) * 1.6);
    const int decimals = std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 9);
    const auto first = static_cast<int>(std::ceil(low / step - 1e-9));
    const auto last = static_cast<int>(std::floor(high / step + 1e-9));
    for (int tick = first; tick <= last; ++tick) {
      const double value = tick * step;
      const int y = bar.y + static_cast<int>(std::lround((high - value) / (high - low) * (bar.height - 1)));
      cv::line(picture, {bar.x + bar.width, y}, {bar.x + bar.width + 4, y}, ink, 1);
      draw_text(picture, number(value, decimals), {label_x, y + 5});
    }
  }
  const std::string name = unit.name[0] != '\0' ? options.layer + " [" + unit.name + "]" : options.layer;
  draw_text(picture, name, {bar.x + bar_column - margin / 2, bar.y + bar.height + margin}, Align::right);
}

/// A bar of a round length, and beside it which way is north.
void draw_scale_bar(cv::Mat& picture, const Layout& layout, const GridGeometry& geometry) {
  const double pixels_per_metre = layout.scale / geometry.cell();
  const double length = round_below(0.3 * std::max(layout.map.width, shortest_map) / pixels_per_metre);
  const int width = std::max(2, static_cast<int>(std::lround(length * pixels_per_metre)));
  const cv::Rect bar(margin, layout.map.y + layout.map.height + 14, width, 7);
  cv::rectangle(picture, bar, ink, 1);
  cv::rectangle(picture, {bar.x, bar.y, bar.width / 2, bar.height}, ink, cv::FILLED);
  draw_text(picture, round_length_text(length), {bar.x, bar.y + bar.height + text_height + 4});
  const cv::Point tip(bar.x + bar.width + 28, bar.y - 3);
  const std::vector<cv::Point> head{tip, tip + cv::Point(-5, 14), tip + cv::Point(0, 11),
                                    tip + cv::Point(5, 14)};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{head}, ink, cv::LINE_AA);
  draw_text(picture, "N", {tip.x, bar.y + bar.height + text_height + 4}, Align::centre);
}

}  // namespace

void write_preview(const HeightMap& map, const std::string& path, const PreviewOptions& options) {
  if (options.width_px < 1)
    throw Error("preview '" + path + "': width is " + std::to_string(options.width_px) +
                " px, must be positive");
  const GridGeometry& geometry = map.geometry();
  const bool automatic = options.range.low == options.range.high;
  const ValueRange range =
      automatic ? display_range(map.layer(options.layer), options.palette) : options.range;
  const Layout layout = layout_for(geometry, options);
  cv::Mat picture(layout.picture, CV_8UC3, paper);
  map_image(map, options, range, layout.map).copyTo(picture(layout.map));
  cv::rectangle(picture, {layout.map.x - 1, layout.map.y - 1, layout.map.width + 2, layout.map.height + 2},
                ink, 1);
  if (!options.title.empty()) draw_text(picture, options.title, {margin, margin + 14}, Align::left, 0.6);
  const int bar_height = std::max(layout.map.height, shortest_map);
  const int bar_x = layout.picture.width - bar_column;
  draw_colour_bar(picture, {bar_x, layout.map.y, bar_width, bar_height}, options, range);
  draw_scale_bar(picture, layout, geometry);
  write_atomically(path, [&](const std::string& temporary) {
    bool written = false;
    try {
      written = cv::imwrite(temporary, picture);
    } catch (const cv::Exception& error) {
      throw Error("preview '" + path + "': " + error.err);
    }
    if (!written) throw Error("preview '" + path + "': cannot be written as PNG");
  });
}

}  // namespace aeolian
