#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/round_length.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_twin/erosion/erosion_files.hpp"

namespace aeolian {
namespace {

constexpr int header_px = 58;
constexpr int footer_px = 40;
constexpr int contours = 6;

const cv::Scalar ink(35, 39, 46);
const cv::Scalar paper(243, 248, 251);

struct Kind {
  const char* name;
  Rgb colour;
};
constexpr Kind hard{"hard ground", {128, 128, 132}};
constexpr Kind loose_sand{"loose sand", {222, 184, 130}};
constexpr Kind loose_snow{"loose snow", {245, 245, 248}};
constexpr Kind sintered_snow{"sintered snow", {140, 178, 214}};

void write(cv::Mat& picture, const std::string& text, cv::Point at, double size) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, ink, 1, cv::LINE_AA);
}

/// Cells that are higher than a multiple of the step which a neighbour to the east or north is not.
bool on_contour(const HeightMap::Layer& heights, const GridGeometry& g, int x, int y, double step) {
  const auto level = [&](int ix, int iy) {
    return std::floor(heights[g.index(std::min(ix, g.nx() - 1), std::min(iy, g.ny() - 1))] / step);
  };
  return level(x, y) != level(x + 1, y) || level(x, y) != level(x, y + 1);
}

}  // namespace

void draw_surface(const HeightMap& map, const Grain& grain, bool snow, const std::string& title,
                  const std::string& path) {
  const GridGeometry& g = map.geometry();
  const HeightMap::Layer& height = map.layer(layer::elevation);
  const auto thin = static_cast<float>(grain.diameter);
  const auto [low, high] = std::minmax_element(height.begin(), height.end(),
                                               [](float a, float b) { return std::isnan(b) || a < b; });
  const double relief = std::max(1e-6, static_cast<double>(*high) - static_cast<double>(*low));
  // Relief of the terrain is shaded as it is, that of a level bed raised so that its forms are seen.
  const double exaggeration = std::clamp(0.02 * g.length_x() / relief, 1.0, 4.0);
  const std::vector<float> light = hill_shade(g, height, exaggeration);
  const bool hilly = relief > 0.03 * g.length_x();
  cv::Mat cells(g.ny(), g.nx(), CV_8UC3);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      const float depth = map.has(layer::ground) ? height[i] - map.layer(layer::ground)[i] : thin + 1;
      const float sintered = map.has("sintered") ? map.layer("sintered")[i] : 0;
      const Kind& kind = depth < thin              ? hard
                         : depth - sintered < thin ? sintered_snow
                         : snow                    ? loose_snow
                                                   : loose_sand;
      const Lighting lamp = lighting(light[i]);
      const bool line = hilly && on_contour(height, g, x, y, relief / contours);
      cv::Vec3b& pixel = cells.at<cv::Vec3b>(g.ny() - 1 - y, x);
      for (int k = 0; k < 3; ++k) {
        const float value =
            static_cast<float>(kind.colour[static_cast<std::size_t>(2 - k)]) * lamp.factor + lamp.white;
        pixel[k] = cv::saturate_cast<std::uint8_t>(line ? 0.5F * value : value);
      }
    }
  const int scale = std::max(1, static_cast<int>(std::lround(768.0 / std::max(g.nx(), 1))));
  cv::Mat enlarged;
  cv::resize(cells, enlarged, {}, scale, scale, cv::INTER_NEAREST);
  cv::Mat picture(enlarged.rows + header_px + footer_px, std::max(enlarged.cols, 600), CV_8UC3, paper);
  enlarged.copyTo(picture(cv::Rect(0, header_px, enlarged.cols, enlarged.rows)));
  write(picture, title, {8, 22}, 0.5);
  int x = 8;
  for (const Kind* kind : {&hard, snow ? &loose_snow : &loose_sand, &sintered_snow}) {
    if (kind == &sintered_snow && !snow) continue;
    const cv::Rect box(x, 34, 16, 16);
    cv::rectangle(picture, box, cv::Scalar(kind->colour[2], kind->colour[1], kind->colour[0]), cv::FILLED);
    cv::rectangle(picture, box, ink, 1);
    write(picture, kind->name, {x + 22, 47}, 0.45);
    x += 150;
  }
  if (hilly) write(picture, fmt::format("contours every {:.3g} m", relief / contours), {x, 47}, 0.45);
  const double length = round_below(g.length_x() / 5);
  const int bar = static_cast<int>(length / g.cell() * scale);
  const int y = picture.rows - 14;
  cv::line(picture, {8, y}, {8 + bar, y}, ink, 3);
  write(picture, round_length_text(length), {16 + bar, y + 5}, 0.45);
  write_atomically(path, [&](const std::string& temporary) {
    if (!cv::imwrite(temporary, picture)) throw Error("'" + path + "' cannot be written");
  });
}

}  // namespace aeolian
