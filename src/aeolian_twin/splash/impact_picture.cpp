#include "aeolian_twin/splash/impact_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <cairo/cairo.h>
#include <fmt/format.h>

#include "aeolian_core/surface/round_length.hpp"

namespace aeolian {
namespace {

struct Colour {
  double red, green, blue;
};

constexpr Colour paper{1, 0.992, 0.976};
constexpr Colour ink{0.18, 0.153, 0.137};
constexpr Colour soft{0.42, 0.376, 0.345};
constexpr Colour marked{0.055, 0.435, 0.62};

Colour mixed(const Colour& a, const Colour& b, double share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue)};
}

/// From sand at rest to glowing: even in lightness.
Colour heat(double share) {
  constexpr std::array<Colour, 6> scale{{{0.906, 0.863, 0.773},
                                         {0.957, 0.780, 0.420},
                                         {0.937, 0.545, 0.220},
                                         {0.839, 0.290, 0.251},
                                         {0.600, 0.120, 0.380},
                                         {0.290, 0.045, 0.365}}};
  const double place = std::clamp(share, 0.0, 1.0) * (scale.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), scale.size() - 2);
  return mixed(scale[i], scale[i + 1], place - static_cast<double>(i));
}

/// Speeds from a hundredth of what carries a grain over its own diameter to that of the impact, by
/// their logarithm.
struct SpeedScale {
  double low, high;
  double operator()(double speed) const {
    return std::log(std::max(speed, low) / low) / std::log(high / low);
  }
};

SpeedScale speed_scale(const Film& film) {
  return {0.03 * std::sqrt(2 * gravity * film.diameter), film.shot.speed};
}

std::string time_text(double seconds) { return fmt::format("{:.1f} ms", 1000 * seconds + 0.0); }

}  // namespace

/// One picture while it is drawn.
class ImpactPicture::Drawing {
 public:
  explicit Drawing(cv::Mat& picture)
      : surface_(cairo_image_surface_create_for_data(picture.data, CAIRO_FORMAT_RGB24, picture.cols,
                                                     picture.rows, static_cast<int>(picture.step)),
                 cairo_surface_destroy),
        cairo_(cairo_create(surface_.get()), cairo_destroy) {
    set(paper);
    cairo_paint(c());
    cairo_set_line_cap(c(), CAIRO_LINE_CAP_ROUND);
  }
  ~Drawing() { cairo_surface_flush(surface_.get()); }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  void ball(double x, double y, double radius, const Colour& colour, const Colour& rim, double rim_width) {
    const std::unique_ptr<cairo_pattern_t, void (*)(cairo_pattern_t*)> light(
        cairo_pattern_create_radial(x - 0.35 * radius, y - 0.4 * radius, 0.1 * radius, x, y, 1.05 * radius),
        cairo_pattern_destroy);
    const Colour bright = mixed(colour, {1, 1, 1}, 0.35);
    const Colour dark = mixed(colour, {0, 0, 0}, 0.12);
    cairo_pattern_add_color_stop_rgb(light.get(), 0, bright.red, bright.green, bright.blue);
    cairo_pattern_add_color_stop_rgb(light.get(), 0.7, colour.red, colour.green, colour.blue);
    cairo_pattern_add_color_stop_rgb(light.get(), 1, dark.red, dark.green, dark.blue);
    cairo_arc(c(), x, y, radius, 0, 2 * M_PI);
    cairo_set_source(c(), light.get());
    cairo_fill_preserve(c());
    stroke(rim_width, rim);
  }
  void line(double x1, double y1, double x2, double y2, double width, const Colour& colour, double dash = 0) {
    cairo_move_to(c(), x1, y1);
    cairo_line_to(c(), x2, y2);
    stroke(width, colour, dash);
  }
  void path(const std::vector<Eigen::Vector2d>& points, double width, const Colour& colour) {
    for (const auto& p : points) cairo_line_to(c(), p.x(), p.y());
    stroke(width, colour);
  }
  void box(double x, double y, double width, double height, const Colour& colour) {
    cairo_rectangle(c(), x, y, width, height);
    set(colour);
    cairo_fill(c());
  }
  /// `most` is how wide it may be, zero: as it is.
  void text(double x, double baseline, double size, bool bold, const Colour& colour, const std::string& words,
            double anchor = 0, double most = 0) {
    cairo_select_font_face(c(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(c(), words.c_str(), &extents);
    if (most > 0 && extents.x_advance > most) {
      cairo_set_font_size(c(), size * most / extents.x_advance);
      cairo_text_extents(c(), words.c_str(), &extents);
    }
    set(colour);
    cairo_move_to(c(), x - anchor * extents.x_advance, baseline);
    cairo_show_text(c(), words.c_str());
    cairo_new_path(c());
  }

 private:
  cairo_t* c() { return cairo_.get(); }
  void set(const Colour& colour) { cairo_set_source_rgb(c(), colour.red, colour.green, colour.blue); }
  void stroke(double width, const Colour& colour, double dash = 0) {
    set(colour);
    cairo_set_line_width(c(), width);
    cairo_set_dash(c(), &dash, dash > 0 ? 1 : 0, 0);
    cairo_stroke(c());
  }

  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
};

ImpactPicture::ImpactPicture(const Film& film, std::string title, int width)
    : film_(film), title_(std::move(title)), width_(width) {
  const double seen = std::clamp(film.length, 22 * film.diameter, 34 * film.diameter);
  scale_ = width / seen;
  left_ = film.impact.x() - 0.5 * seen;
  if (!film.periodic)
    left_ = film.length > seen ? std::clamp(left_, 0.0, film.length - seen) : 0.5 * (film.length - seen);
  bottom_ = std::max(-0.25 * film.diameter, film.top - 0.38 * seen);
  top_ = film.top + 0.34 * seen;
  height_ = 2 * static_cast<int>(std::round(0.5 * scale_ * (top_ - bottom_) + 0.5 * 0.06 * width));
}

cv::Mat ImpactPicture::draw(std::size_t index) const {
  const FilmFrame& frame = film_.frames[index];
  cv::Mat picture(height_, width_, CV_8UC4);
  const double unit = width_ / 1200.;
  const SpeedScale speed = speed_scale(film_);
  const auto px = [&](double x) { return scale_ * (x - left_); };
  const auto py = [&](double z) { return scale_ * (top_ - z); };
  Drawing drawing(picture);

  const double before = -film_.length;  // how far back the straight path of arrival is drawn
  std::vector<Eigen::Vector2d> path{{px(film_.impact.x() + before * std::cos(film_.shot.angle)),
                                     py(film_.impact.z() - before * std::sin(film_.shot.angle))}};
  if (frame.time >= 0) path.emplace_back(px(film_.impact.x()), py(film_.impact.z()));
  for (std::size_t i = 0; i <= index; ++i)
    for (const FilmGrain& grain : film_.frames[i].grains)
      if (grain.incident && (film_.frames[i].time >= 0 || i == index))
        path.emplace_back(px(grain.place.x()), py(grain.place.z()));
  for (const FilmGrain& grain : frame.grains) {
    const Colour colour = heat(speed(grain.speed));
    if (!grain.incident)
      drawing.ball(px(grain.place.x()), py(grain.place.z()), scale_ * grain.radius, colour,
                   mixed(colour, {0.25, 0.18, 0.12}, 0.55), 1.1 * unit);
  }
  drawing.path(path, 2.5 * unit, marked);
  for (const FilmGrain& grain : frame.grains)
    if (grain.incident)
      drawing.ball(px(grain.place.x()), py(grain.place.z()), scale_ * grain.radius, marked, {1, 1, 1},
                   2.5 * unit);

  const double floor = py(bottom_);
  drawing.box(0, floor, width_, height_ - floor, paper);
  drawing.line(0, floor, width_, floor, 1.2 * unit, soft);

  drawing.text(28 * unit, 54 * unit, 34 * unit, true, ink, time_text(frame.time));
  drawing.text(28 * unit, 86 * unit, 19 * unit, false, soft, title_, 0, width_ - 56 * unit);

  const double bar = round_below(0.2 * width_ / scale_);
  const double y = 0.5 * (floor + height_);
  drawing.line(28 * unit, y, 28 * unit + scale_ * bar, y, 4 * unit, ink);
  drawing.text(44 * unit + scale_ * bar, y + 6 * unit, 19 * unit, false, ink, round_length_text(bar));

  const double right = width_ - 28 * unit;
  const double from = right - 330 * unit;
  drawing.ball(right - 640 * unit, y, 9 * unit, marked, {1, 1, 1}, 2 * unit);
  drawing.text(right - 622 * unit, y + 6 * unit, 19 * unit, false, ink, "incident grain");
  constexpr int steps = 165;
  for (int i = 0; i < steps; ++i)
    drawing.box(from + 2 * i * unit, y - 19 * unit, 2.6 * unit, 14 * unit, heat((i + 0.5) / steps));
  drawing.text(from - 12 * unit, y - 5 * unit, 19 * unit, false, ink, "speed", 1);
  for (double tick = std::pow(10, std::ceil(std::log10(speed.low))); tick <= speed.high * 1.001; tick *= 10) {
    const double x = from + 330 * unit * speed(tick);
    drawing.line(x, y - 19 * unit, x, y - 1 * unit, 1.2 * unit, ink);
    const bool last = tick * 10 > speed.high;
    drawing.text(x, y + 19 * unit, 17 * unit, false, ink, fmt::format("{:g}{}", tick, last ? " m/s" : ""),
                 last ? 0.3 : 0.5);
  }
  return picture;
}

}  // namespace aeolian
