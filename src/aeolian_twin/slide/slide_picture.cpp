#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/round_length.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_twin/photo/canvas.hpp"
#include "aeolian_twin/slide/slide_files.hpp"

namespace aeolian {
namespace {

constexpr int width = 1100;  ///< [px]
constexpr int margin = 40;
constexpr int head_room = 70;  ///< for the words over a panel
constexpr Ink dark{0.18, 0.153, 0.137};
constexpr Ink soft{0.42, 0.376, 0.345};

/// What a picture shows of the world.
struct View {
  double left, right, bottom, top;  ///< [m]
  double scale;                     ///< [px/m]
  int height;                       ///< [px]
  cv::Point2d at(double x, double z, int offset) const {
    return {margin + (x - left) * scale, offset + head_room + (top - z) * scale};
  }
};

template <int Dim>
View view_of(const SlideScene& scene, const KeptEvent<Dim>& kept) {
  const auto frame = panel_frame<2>(scene);
  const double reach = 0.5 * scene.panel_length;
  View v{frame.centre[0] - reach,
         frame.centre[0] + reach,
         0,
         frame.centre[1] + reach * std::sin(scene.tilt),
         0,
         0};
  for (const auto* snow : {&kept.event.snow, &kept.in_motion})
    for (const auto& p : *snow) {
      v.left = std::min(v.left, p.place[0]);
      v.right = std::max(v.right, p.place[0]);
      v.bottom = std::min(v.bottom, p.place[Dim - 1]);
      v.top = std::max(v.top, p.place[Dim - 1]);
    }
  const double rim = 0.03 * (v.right - v.left);
  v = {v.left - rim, v.right + rim, v.bottom - rim, v.top + rim, 0, 0};
  v.scale = (width - 2 * margin) / (v.right - v.left);
  v.height = static_cast<int>(std::ceil((v.top - v.bottom) * v.scale)) + head_room + 20;
  return v;
}

/// The words, the scale of colours and its ends.
struct Legend {
  std::string title;
  std::string quantity;
  double low, high;
};

void draw_words(cv::Mat& picture, int offset, const Legend& legend) {
  Canvas canvas(picture, 1);
  canvas.text(margin, offset + 28, 17, true, dark, legend.title);
  const int left = margin, bar = 240;
  for (int x = 0; x < bar; ++x) {
    const Rgb c = colour(Palette::viridis, static_cast<double>(x) / bar);
    canvas.box(left + x, offset + 42, 1.5, 10, {c[0] / 255., c[1] / 255., c[2] / 255.});
  }
  canvas.text(left + bar + 12, offset + 52, 13, false, soft,
              fmt::format("{}: {:.3g} to {:.3g}", legend.quantity, legend.low, legend.high));
}

void draw_panel(cv::Mat& picture, const View& view, const SlideScene& scene, int offset) {
  const auto frame = panel_frame<2>(scene);
  const Point<2> along = 0.5 * scene.panel_length * frame.axes.col(0);
  const Point<2> in = -4 * scene.cell * frame.axes.col(1);
  std::vector<cv::Point> corners;
  for (const Point<2>& corner : {Point<2>(-along), along, Point<2>(along + in), Point<2>(in - along)})
    corners.push_back(view.at(frame.centre[0] + corner[0], frame.centre[1] + corner[1], offset));
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(152, 143, 138, 255),
               cv::LINE_AA);
}

void draw_ground(cv::Mat& picture, const View& view, const SlideScene& scene, int offset) {
  const auto ground = obstacles_of<2>(scene).back().shape;
  std::vector<cv::Point> line;
  for (int x = margin; x <= width - margin; x += 2) {
    const Point<2> place(view.left + (x - margin) / view.scale, 0);
    const auto near = ground->at(place);
    line.push_back(view.at(place[0], -near.distance / near.normal[1], offset));
  }
  cv::polylines(picture, line, false, cv::Scalar(74, 65, 58, 255), 2, cv::LINE_AA);
}

/// A tenth of the picture or so, in round numbers.
void draw_scale_bar(cv::Mat& picture, const View& view, int offset) {
  const double length = round_below(0.2 * (view.right - view.left));
  Canvas canvas(picture, 1);
  const double right = width - margin, left = right - length * view.scale;
  canvas.stroke(left, offset + 47, right, offset + 47, 2, dark);
  canvas.text(left, offset + 38, 13, false, dark, round_length_text(length));
}

template <int Dim>
void draw_snow(cv::Mat& picture, const View& view, const SlideScene& scene, int offset,
               const std::vector<MaterialPoint<Dim>>& snow, const Legend& legend,
               const std::function<double(const MaterialPoint<Dim>&)>& value) {
  const double half_slice = Dim == 3 ? scene.cell : 1e9;
  for (const auto& p : snow) {
    if (Dim == 3 && std::abs(p.place[1]) > half_slice) continue;
    const double size = 0.55 * std::pow(p.volume, 1. / Dim) * view.scale;
    const Rgb c = colour(Palette::viridis, (value(p) - legend.low) / (legend.high - legend.low));
    cv::circle(picture, view.at(p.place[0], p.place[Dim - 1], offset),
               std::max(1, static_cast<int>(std::lround(size))), cv::Scalar(c[2], c[1], c[0], 255),
               cv::FILLED, cv::LINE_AA);
  }
}

}  // namespace

template <int Dim>
void draw_event(const SlideConfig& config, const KeptEvent<Dim>& kept, const std::string& folder) {
  const SlideScene& scene = config.scene;
  const View view = view_of<Dim>(scene, kept);
  cv::Mat picture(2 * view.height, width, CV_8UC4, cv::Scalar(249, 253, 255, 255));
  const auto speed = [](const MaterialPoint<Dim>& p) { return p.velocity.norm(); };
  const auto strength = [&](const MaterialPoint<Dim>& p) {
    return scene.snow.consolidation_at(p.alpha) / 1000;
  };
  double fastest = 1e-3, strongest = scene.snow.consolidation / 1000;
  for (const auto& p : kept.in_motion) fastest = std::max(fastest, speed(p));
  for (const auto& p : kept.event.snow) strongest = std::max(strongest, strength(p));
  const char* slice = Dim == 3 ? ", middle slice" : "";
  const Legend legends[] = {{fmt::format("{}: event {}, {:.2f} s after release{}", config.name,
                                         kept.event.number, kept.motion_time, slice),
                             "speed [m/s]", 0, fastest},
                            {fmt::format("at rest after {:.2f} s: {:.3f} m high, {:.3f} m long",
                                         kept.event.duration, kept.event.pile.height, kept.event.pile.length),
                             "p0, what the snow bears [kPa]", 0, strongest}};
  for (int half = 0; half < 2; ++half) {
    const int offset = half * view.height;
    draw_ground(picture, view, scene, offset);
    draw_panel(picture, view, scene, offset);
    if (half == 0)
      draw_snow<Dim>(picture, view, scene, offset, kept.in_motion, legends[half], speed);
    else
      draw_snow<Dim>(picture, view, scene, offset, kept.event.snow, legends[half], strength);
    draw_words(picture, offset, legends[half]);
    draw_scale_bar(picture, view, offset);
  }
  write_atomically(fmt::format("{}/event_{:02}.png", folder, kept.event.number),
                   [&](const std::string& path) { cv::imwrite(path, picture); });
}

template void draw_event(const SlideConfig&, const KeptEvent<2>&, const std::string&);
template void draw_event(const SlideConfig&, const KeptEvent<3>&, const std::string&);

}  // namespace aeolian
