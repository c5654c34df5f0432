#include "aeolian_twin/photo/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_twin/photo/canvas.hpp"
#include "aeolian_twin/photo/figure_text.hpp"
#include "aeolian_twin/photo/figure_units.hpp"

namespace aeolian {
namespace {

constexpr Ink edge_ink{0.1, 0.85, 1};
constexpr Ink band_ink{1, 1, 1, 0.75};
constexpr Ink terminus_ink{1, 0.1, 0.55};
constexpr Ink interval_ink{1, 0.1, 0.55, 0.3};
constexpr Ink crest_ink{1, 0.55, 0};
constexpr Ink trough_ink{0.15, 0.4, 1};
constexpr Ink mark_ink{0.3, 1, 0.3};
constexpr Ink halo{0, 0, 0, 0.45};
constexpr Ink paper{0.08, 0.06, 0.05, 0.78};
constexpr Ink white{1, 1, 1};

Eigen::Vector2d mean(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) sum += point;
  return points.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(points.size()));
}

/// Draws one photo's overlay on a copy of it.
class Overlay {
 public:
  Overlay(cv::Mat& picture, double scale, const MeasuredPhoto& photo)
      : canvas_(picture, scale),
        photo_(photo),
        profile_(photo.profile),
        width_(picture.cols),
        height_(picture.rows),
        scale_(scale),
        thin_(std::max(1.0, width_ / 1200.0)),
        font_(std::max(11.0, std::min(width_ / 95.0, height_ / 52.0))) {
    // Square to the edge, or to the shadow's end where the edge is not told; away from the edge.
    const std::vector<Eigen::Vector2d>& line =
        profile_.edge_px.size() > 1 ? profile_.edge_px : profile_.terminus_px;
    const Eigen::Vector2d along = (line.back() - line.front()).normalized();
    outwards_ = {-along.y(), along.x()};
    if (outwards_.dot(mean(profile_.terminus_px) - mean(line)) < 0) outwards_ = -outwards_;
  }

  void draw() {
    canvas_.line(profile_.band_px, thin_, band_ink, 8 * thin_, true);
    canvas_.line(profile_.edge_px, 4 * thin_, halo);
    canvas_.line(profile_.edge_px, 1.6 * thin_, edge_ink);
    for (const Eigen::Vector2d& mark : profile_.mark_px)
      canvas_.cross(mark, 5 * thin_, 1.2 * thin_, mark_ink);
    draw_terminus();
    draw_ripples();
    draw_words();
  }

 private:
  /// Stretches without gaps, so that no line is drawn where nothing was found.
  template <class Visit>
  void for_each_stretch(Visit&& visit) const {
    std::vector<double> steps;
    for (std::size_t i = 1; i < profile_.x.size(); ++i) steps.push_back(profile_.x[i] - profile_.x[i - 1]);
    if (steps.empty()) return;
    const double gap = 5 * median(steps);
    std::size_t first = 0;
    for (std::size_t i = 1; i <= profile_.x.size(); ++i)
      if (i == profile_.x.size() || profile_.x[i] - profile_.x[i - 1] > gap) {
        visit(first, i);
        first = i;
      }
  }

  /// 1.96 standard errors of the height, as the shadow's length shows them [px of the photo].
  double half_interval(std::size_t station) const {
    return 1.96 * profile_.sigma_z[station] * profile_.scale.value * std::cos(profile_.azimuth.value) /
           std::tan(profile_.elevation.value);
  }

  void draw_terminus() {
    for_each_stretch([&](std::size_t first, std::size_t end) {
      std::vector<Eigen::Vector2d> line;
      double wide = 0;
      for (std::size_t i = first; i < end; ++i) {
        line.push_back(profile_.terminus_px[i]);
        wide += 2 * half_interval(i) * scale_ / static_cast<double>(end - first);
      }
      canvas_.line(line, std::max(wide, 3 * thin_), interval_ink);
      canvas_.line(line, thin_, terminus_ink);
    });
  }

  /// Where the shadow's end is seen at a place along the horizontal.
  Eigen::Vector2d terminus_at(double place) const {
    const auto nearest = std::min_element(places_.begin(), places_.end(), [place](double a, double b) {
      return std::abs(a - place) < std::abs(b - place);
    });
    return profile_.terminus_px[static_cast<std::size_t>(nearest - places_.begin())];
  }

  void draw_ripples() {
    const double size = 9 * thin_;
    double last = -INFINITY;
    for (const ProfileRipple& ripple : photo_.analysis.ripples) {
      if (ripple.start > last + 1e-6) canvas_.pointer(terminus_at(ripple.start), outwards_, size, trough_ink);
      canvas_.pointer(terminus_at(ripple.end), outwards_, size, trough_ink);
      canvas_.pointer(terminus_at(ripple.crest), outwards_, size, crest_ink);
      last = ripple.end;
    }
  }

  std::vector<std::string> words() const {
    const ProfileAnalysis& analysis = photo_.analysis;
    const auto with = [](const Figure& figure, double factor) { return stated(figure, factor, "±"); };
    std::vector<std::string> lines;
    if (analysis.ripples.empty()) {
      lines.emplace_back("no ripples");
    } else {
      lines.push_back(fmt::format("{} {}: wavelength {} mm", analysis.ripples.size(),
                                  analysis.ripples.size() == 1 ? "ripple" : "ripples",
                                  with(analysis.wavelength, to_mm)));
      lines.push_back(
          fmt::format("height {} mm, index {}", with(analysis.height, to_mm), with(analysis.index, 1)));
      lines.push_back(fmt::format("stoss {}°, lee {}°", with(analysis.stoss_mean, to_degrees),
                                  with(analysis.lee_mean, to_degrees)));
    }
    lines.push_back(fmt::format("roughness {} mm", with(analysis.roughness, to_mm)));
    lines.push_back(fmt::format("light {}° high, {}° off the normal", with(profile_.elevation, to_degrees),
                                with(profile_.azimuth, to_degrees)));
    lines.push_back(fmt::format("scale {} px/mm{}", with(profile_.scale, 1 / to_mm),
                                profile_.mode == ProfileMode::overhead ? ", overhead mode" : ""));
    for (const std::string& remark : profile_.remarks) lines.push_back(remark);
    return lines;
  }

  /// A line of the legend.
  struct Sign {
    std::string words;
    Ink ink;
    bool pointer = false;
  };
  std::vector<Sign> signs() const {
    std::vector<Sign> result;
    if (!profile_.edge_px.empty()) result.push_back({"casting edge", edge_ink});
    if (!profile_.band_px.empty()) result.push_back({"searched", band_ink});
    result.push_back({"shadow's end, 95 %", terminus_ink});
    if (!profile_.mark_px.empty()) result.push_back({"marks", mark_ink});
    if (photo_.analysis.ripples.empty()) return result;
    result.push_back({"crests", crest_ink, true});
    result.push_back({"troughs", trough_ink, true});
    return result;
  }

  /// The upper left corner of a box in that corner of the picture where it hides least.
  Eigen::Vector2d free_corner(double wide, double high) const {
    Eigen::Vector2d best(0, 0);
    std::ptrdiff_t least = PTRDIFF_MAX;
    for (const double top : {0.0, height_ - high})
      for (const double left : {0.0, width_ - wide}) {
        const auto hidden = [&](const Eigen::Vector2d& point) {
          const Eigen::Vector2d p = scale_ * point - Eigen::Vector2d(left, top);
          return p.x() > 0 && p.x() < wide && p.y() > 0 && p.y() < high;
        };
        std::ptrdiff_t count = 0;
        for (const auto* points :
             {&profile_.terminus_px, &profile_.edge_px, &profile_.mark_px, &profile_.band_px})
          count += std::count_if(points->begin(), points->end(), hidden);
        if (count < least) {
          least = count;
          best = {left, top};
        }
      }
    return best;
  }

  void draw_words() {
    const std::vector<std::string> lines = words();
    const std::vector<Sign> legend = signs();
    const double row = 1.45 * font_;
    const double margin = 0.8 * font_;
    double wide = canvas_.text_width(1.15 * font_, true, photo_.name);
    for (const std::string& line : lines) wide = std::max(wide, canvas_.text_width(font_, false, line));
    const double high = row * (static_cast<double>(1 + lines.size() + legend.size()) + 0.4) + 2 * margin;
    wide = std::min(wide + 2 * margin, static_cast<double>(width_));
    const Eigen::Vector2d corner = free_corner(wide + 2 * margin, high + 2 * margin);
    const double left = corner.x() + margin;
    const double top = corner.y() + margin;
    canvas_.box(left, top, wide, high, paper);
    double baseline = top + margin + font_;
    canvas_.text(left + margin, baseline, 1.15 * font_, true, white, photo_.name);
    for (const std::string& line : lines)
      canvas_.text(left + margin, baseline += row, font_, false, white, line);
    baseline += 0.4 * row;
    for (const Sign& sign : legend) {
      baseline += row;
      const double y = baseline - 0.35 * font_;
      if (sign.pointer)
        canvas_.pointer(canvas_.pixel_at(left + margin + font_, y - 0.55 * font_), {0, 1}, 0.8 * font_,
                        sign.ink);
      else
        canvas_.stroke(left + margin, y, left + margin + 2 * font_, y, 0.2 * font_, sign.ink);
      canvas_.text(left + margin + 2.6 * font_, baseline, font_, false, white, sign.words);
    }
  }

  Canvas canvas_;
  const MeasuredPhoto& photo_;
  const ShadowProfile& profile_;
  std::vector<double> places_ = horizontal_places(photo_.profile);
  int width_;
  int height_;
  double scale_;
  double thin_;  ///< width of a thin line [px of the picture]
  double font_;  ///< size of the words [px of the picture]
  Eigen::Vector2d outwards_;
};

}  // namespace

cv::Mat draw_overlay(const cv::Mat& picture, const MeasuredPhoto& photo, int widest) {
  const double scale = std::min(1.0, static_cast<double>(widest) / picture.cols);
  cv::Mat canvas;
  cv::resize(picture, canvas, {}, scale, scale, cv::INTER_AREA);
  cv::cvtColor(canvas, canvas, cv::COLOR_BGR2BGRA);
  Overlay(canvas, scale, photo).draw();
  cv::cvtColor(canvas, canvas, cv::COLOR_BGRA2BGR);
  return canvas;
}

}  // namespace aeolian
