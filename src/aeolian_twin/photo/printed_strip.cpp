#include "aeolian_twin/photo/printed_strip.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include <cairo/cairo-pdf.h>
#include <fmt/format.h>
#include <opencv2/aruco.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_twin/photo/figure_units.hpp"

namespace aeolian {
namespace {

// Lengths below are millimetres, as on paper.
constexpr double page_width = 297;
constexpr double page_height = 210;
constexpr double margin = 13.5;
constexpr double pieces_top = 44;
constexpr double gap = 9;         ///< between pieces, with room for their names
constexpr double scale_band = 9;  ///< from the casting edge to the markers: ticks, numbers, words, white
constexpr double yaml_row = 3.6;
constexpr int dictionary_size = 50;
constexpr int modules = 6;  ///< of a marker's side: 4 and its black border

/// Gives where the words end.
double text(cairo_t* cairo, double x, double baseline, double size, const std::string& words,
            bool bold = false, bool typewriter = false) {
  cairo_select_font_face(cairo, typewriter ? "monospace" : "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
  cairo_move_to(cairo, x, baseline);
  cairo_show_text(cairo, words.c_str());
  double end = 0;
  cairo_get_current_point(cairo, &end, nullptr);
  cairo_new_path(cairo);
  return end;
}

void line(cairo_t* cairo, double x1, double y1, double x2, double y2, double width) {
  cairo_move_to(cairo, x1, y1);
  cairo_line_to(cairo, x2, y2);
  cairo_set_line_width(cairo, width);
  cairo_stroke(cairo);
}

void arrow_up(cairo_t* cairo, double x, double tip, double size) {
  cairo_move_to(cairo, x, tip);
  cairo_line_to(cairo, x + 0.5 * size, tip + size);
  cairo_line_to(cairo, x - 0.5 * size, tip + size);
  cairo_close_path(cairo);
  cairo_fill(cairo);
}

void draw_marker(cairo_t* cairo, int id, double left, double top, double size) {
  cv::Mat cells;
  cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50), id, modules, cells, 1);
  cairo_rectangle(cairo, left, top, size, size);
  cairo_fill(cairo);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  const double cell = size / modules;
  for (int row = 0; row < modules; ++row)
    for (int column = 0; column < modules; ++column)
      if (cells.at<std::uint8_t>(row, column) > 0)
        cairo_rectangle(cairo, left + column * cell, top + row * cell, cell, cell);
  cairo_fill(cairo);  // all at once: no seams between neighbours
  cairo_set_source_rgb(cairo, 0, 0, 0);
}

/// Ticks and numbers from `from` to `to`, whose zero would be at `zero` on the page.
void draw_ticks(cairo_t* cairo, double zero, double top, int from, int to) {
  for (int mm = from; mm <= to; ++mm) {
    const double length = mm % 10 == 0 ? 4 : mm % 5 == 0 ? 2.5 : 1.5;
    line(cairo, zero + mm, top, zero + mm, top + length, mm % 10 == 0 ? 0.2 : 0.12);
    if (mm % 10 == 0 && mm < to) text(cairo, zero + mm + 0.45, top + 4.4, 2.1, std::to_string(mm));
  }
}

/// Says on the strip itself which way round it belongs.
void draw_words(cairo_t* cairo, double left, double top, double length) {
  constexpr double every = 90;
  constexpr double longest = 50;
  for (double x = left + 6; x + longest < left + length; x += every) {
    arrow_up(cairo, x, top + 4.9, 1.5);
    const double end = text(cairo, x + 1.6, top + 6.5, 1.9, "casting edge: this side to the shadow", true);
    arrow_up(cairo, end + 1.6, top + 4.9, 1.5);
  }
}

void draw_check_line(cairo_t* cairo) {
  const double y = 33;
  line(cairo, margin, y, margin + 100, y, 0.25);
  line(cairo, margin, y - 2.5, margin, y + 2.5, 0.25);
  line(cairo, margin + 100, y - 2.5, margin + 100, y + 2.5, 0.25);
  text(cairo, margin + 104, y + 1.1, 3.2,
       "This line must measure 100 mm. If it does not, the print is of no use.");
}

std::size_t pieces_on_page(double width) {
  return static_cast<std::size_t>((page_height - margin - pieces_top + gap) / (width + gap));
}

std::vector<std::string> lines_of(const std::string& words) {
  std::vector<std::string> lines;
  for (std::string_view rest = words; !rest.empty();) lines.emplace_back(take_line(rest));
  return lines;
}

}  // namespace

PrintedStrip::PrintedStrip(double length, double marker_size) {
  const double size_mm = to_mm * marker_size;
  if (!(size_mm >= 5 && size_mm <= 100))
    throw Error(fmt::format("strip: markers of {:g} mm, must be from 5 to 100", size_mm));
  const double quiet = size_mm / modules;
  const double pitch_mm = 10 * std::ceil((size_mm + 2 * quiet) / 10);
  const double count = std::ceil(to_mm * length / pitch_mm - 1e-9);
  if (!(count >= 1 && count <= dictionary_size))
    throw Error(fmt::format("strip: a length of {:g} mm, must be up to {:g} with markers of {:g} mm",
                            to_mm * length, dictionary_size * pitch_mm, size_mm));
  pitch_ = pitch_mm / to_mm;
  markers_.dictionary = "DICT_4X4_50";
  markers_.size = marker_size;
  for (int id = 0; id < static_cast<int>(count); ++id)
    markers_.centres.push_back({id, {(id + 0.5) * pitch_, -(scale_band + size_mm / 2) / to_mm}});
}

double PrintedStrip::width() const {
  const double size_mm = to_mm * markers_.size;
  return (scale_band + size_mm + std::max(2.0, size_mm / modules)) / to_mm;
}

std::size_t PrintedStrip::pieces() const {
  const auto whole = static_cast<std::size_t>((page_width - 2 * margin) / (to_mm * pitch_));
  return (markers_.centres.size() + whole - 1) / whole;
}

std::string PrintedStrip::yaml() const {
  std::string result =
      fmt::format("straightedge:\n  markers:\n    dictionary: {}\n    size_mm: {:g}\n    centres_mm: [",
                  markers_.dictionary, to_mm * markers_.size);
  for (const auto& centre : markers_.centres) {
    if (centre.id > 0) result += centre.id % 8 == 0 ? ",\n                 " : ", ";
    result +=
        fmt::format("[{}, {:g}, {:g}]", centre.id, to_mm * centre.position.x(), to_mm * centre.position.y());
  }
  return result + "]\n";
}

std::size_t PrintedStrip::pages() const {
  const std::size_t each = pieces_on_page(to_mm * width());
  const std::size_t full = (pieces() + each - 1) / each;
  const std::size_t on_last = pieces() - (full - 1) * each;
  const double free =
      page_height - margin - pieces_top - static_cast<double>(on_last) * (to_mm * width() + gap);
  const double needed = yaml_row * static_cast<double>(lines_of(yaml()).size() + 2);
  return full + (needed > free ? 1 : 0);
}

void PrintedStrip::draw(cairo_t* cairo, std::size_t page) const {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  cairo_set_source_rgb(cairo, 0, 0, 0);
  text(cairo, margin, 19, 5, fmt::format("Strip for the straightedge, page {} of {}", page + 1, pages()),
       true);
  text(cairo, margin, 25.5, 3.2,
       "Print at 100 % (\"actual size\", not \"fit to page\"), cut along the lines, glue flat onto the top "
       "face: the "
       "upper border on the casting edge, pieces end to end.");
  draw_check_line(cairo);

  const double strip_width = to_mm * width();
  const double pitch = to_mm * pitch_;
  const auto whole = static_cast<std::size_t>((page_width - 2 * margin) / pitch);
  const std::size_t each = pieces_on_page(strip_width);
  double top = pieces_top;
  for (std::size_t piece = page * each; piece < std::min(pieces(), (page + 1) * each); ++piece) {
    const std::size_t first = piece * whole;
    const std::size_t end = std::min(first + whole, markers_.centres.size());
    const double from = pitch * static_cast<double>(first);
    const double long_mm = pitch * static_cast<double>(end - first);
    text(cairo, margin, top - 1.5, 2.6,
         fmt::format("piece {} of {}: {:g} to {:g} mm", piece + 1, pieces(), from, from + long_mm));
    cairo_rectangle(cairo, margin, top, long_mm, strip_width);
    cairo_set_line_width(cairo, 0.08);
    cairo_stroke(cairo);
    draw_ticks(cairo, margin - from, top, static_cast<int>(from), static_cast<int>(from + long_mm));
    draw_words(cairo, margin, top, long_mm);
    const double size = to_mm * markers_.size;
    for (std::size_t i = first; i < end; ++i) {
      const Eigen::Vector2d centre = to_mm * markers_.centres[i].position;
      draw_marker(cairo, markers_.centres[i].id, margin + centre.x() - from - size / 2,
                  top - centre.y() - size / 2, size);
    }
    top += strip_width + gap;
  }
  if (page + 1 < pages()) return;
  text(cairo, margin, top + 1, 3, "For the setup file (also in the .yaml file beside this one):");
  for (const std::string& row : lines_of(yaml()))
    text(cairo, margin, (top += yaml_row) + 2, 2.8, row, false, true);
}

std::string write_strip(const PrintedStrip& strip, const std::string& pdf) {
  constexpr double points = 72 / 25.4;  // per millimetre
  write_atomically(pdf, [&](const std::string& temporary) {
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        cairo_pdf_surface_create(temporary.c_str(), points * page_width, points * page_height),
        cairo_surface_destroy);
    const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(cairo.get(), points, points);
    for (std::size_t page = 0; page < strip.pages(); ++page) {
      strip.draw(cairo.get(), page);
      cairo_show_page(cairo.get());
    }
    cairo_surface_finish(surface.get());
    if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS)
      throw Error("strip '" + pdf + "': " + cairo_status_to_string(status));
  });
  std::string yaml = std::filesystem::path(pdf).replace_extension(".yaml").string();
  write_text_atomically(yaml, strip.yaml());
  return yaml;
}

}  // namespace aeolian
