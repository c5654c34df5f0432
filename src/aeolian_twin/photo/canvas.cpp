#include "aeolian_twin/photo/canvas.hpp"

namespace aeolian {

Canvas::Canvas(cv::Mat& picture, double scale)
    : surface_(cairo_image_surface_create_for_data(picture.data, CAIRO_FORMAT_RGB24, picture.cols,
                                                   picture.rows, static_cast<int>(picture.step)),
               cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy),
      scale_(scale) {
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
}

/// Cairo counts from the corner of the upper left pixel, photos from its middle.
Eigen::Vector2d Canvas::placed(const Eigen::Vector2d& pixel) const {
  return scale_ * (pixel + Eigen::Vector2d(0.5, 0.5));
}

void Canvas::set(const Ink& ink) {
  cairo_set_source_rgba(cairo_.get(), ink.red, ink.green, ink.blue, ink.alpha);
}

void Canvas::draw_stroke(double width, const Ink& ink, double dash) {
  set(ink);
  cairo_set_line_width(cairo_.get(), width);
  cairo_set_dash(cairo_.get(), &dash, dash > 0 ? 1 : 0, 0);
  cairo_stroke(cairo_.get());
}

void Canvas::line(const std::vector<Eigen::Vector2d>& points, double width, const Ink& ink, double dash,
                  bool closed) {
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d p = placed(point);
    cairo_line_to(cairo_.get(), p.x(), p.y());
  }
  if (closed) cairo_close_path(cairo_.get());
  draw_stroke(width, ink, dash);
}

void Canvas::cross(const Eigen::Vector2d& point, double size, double width, const Ink& ink) {
  const Eigen::Vector2d p = placed(point);
  stroke(p.x() - size, p.y(), p.x() + size, p.y(), width, ink);
  stroke(p.x(), p.y() - size, p.x(), p.y() + size, width, ink);
}

void Canvas::pointer(const Eigen::Vector2d& point, const Eigen::Vector2d& away, double size, const Ink& ink) {
  const Eigen::Vector2d tip = placed(point) + 0.3 * size * away;
  const Eigen::Vector2d side(-away.y(), away.x());
  const Eigen::Vector2d left = tip + size * (away + 0.55 * side);
  const Eigen::Vector2d right = tip + size * (away - 0.55 * side);
  cairo_move_to(cairo_.get(), tip.x(), tip.y());
  cairo_line_to(cairo_.get(), left.x(), left.y());
  cairo_line_to(cairo_.get(), right.x(), right.y());
  cairo_close_path(cairo_.get());
  set(ink);
  cairo_fill_preserve(cairo_.get());
  draw_stroke(0.12 * size, {1, 1, 1}, 0);
}

void Canvas::box(double x, double y, double width, double height, const Ink& ink) {
  cairo_rectangle(cairo_.get(), x, y, width, height);
  set(ink);
  cairo_fill(cairo_.get());
}

void Canvas::set_font(double size, bool bold) {
  cairo_select_font_face(cairo_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), size);
}

void Canvas::text(double x, double baseline, double size, bool bold, const Ink& ink,
                  const std::string& words) {
  set_font(size, bold);
  set(ink);
  cairo_move_to(cairo_.get(), x, baseline);
  cairo_show_text(cairo_.get(), words.c_str());
  cairo_new_path(cairo_.get());
}

double Canvas::text_width(double size, bool bold, const std::string& words) {
  set_font(size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::stroke(double x1, double y1, double x2, double y2, double width, const Ink& ink) {
  cairo_move_to(cairo_.get(), x1, y1);
  cairo_line_to(cairo_.get(), x2, y2);
  draw_stroke(width, ink, 0);
}

}  // namespace aeolian
