#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <cairo/cairo.h>
#include <opencv2/core.hpp>

namespace aeolian {

struct Ink {
  double red, green, blue, alpha = 1;
};

/// Draws over a photograph, in its pixels or in those of its scaled copy.
class Canvas {
 public:
  /// `picture` has 4 channels, 8 bits, and outlives the canvas; a pixel of the photo is `scale` of its own.
  Canvas(cv::Mat& picture, double scale);

  /// Lines in the photo's pixels; width in the picture's. `dash` 0 draws them through.
  void line(const std::vector<Eigen::Vector2d>& points, double width, const Ink& ink, double dash = 0,
            bool closed = false);
  void cross(const Eigen::Vector2d& point, double size, double width, const Ink& ink);
  /// A triangle with a white rim, its point on `point`, its body towards `away` (unit vector).
  void pointer(const Eigen::Vector2d& point, const Eigen::Vector2d& away, double size, const Ink& ink);

  /// The photo's pixel at a place of the picture.
  Eigen::Vector2d pixel_at(double x, double y) const {
    return Eigen::Vector2d(x, y) / scale_ - Eigen::Vector2d(0.5, 0.5);
  }

  // In the picture's own pixels.
  void box(double x, double y, double width, double height, const Ink& ink);
  void text(double x, double baseline, double size, bool bold, const Ink& ink, const std::string& words);
  double text_width(double size, bool bold, const std::string& words);
  void stroke(double x1, double y1, double x2, double y2, double width, const Ink& ink);

 private:
  void set(const Ink& ink);
  void set_font(double size, bool bold);
  Eigen::Vector2d placed(const Eigen::Vector2d& pixel) const;
  void draw_stroke(double width, const Ink& ink, double dash);

  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
  double scale_;
};

}  // namespace aeolian
