#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/twin/report_style.hpp"
#include "aeolian_core/twin/report_text.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/comparison/compared_surfaces.hpp"
#include "aeolian_twin/comparison/figure_words.hpp"

namespace aeolian {
namespace {

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
  }
  return text;
}

std::string picture(const ComparisonPicture& of, const std::string& folder) {
  const bool svg = extension_of(of.file) == "svg";
  const std::string data = base64(read_text(folder + "/" + of.file, "picture"));
  return fmt::format(
      "<figure{}><h3>{}</h3><img src=\"data:image/{};base64,{}\" "
      "alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
      of.wide ? " class=\"wide\"" : "", escape_html(of.title), svg ? "svg+xml" : "png", data,
      escape_html(of.title), escape_html(of.caption));
}

/// A table of figures, a row at a time.
class FigureTable {
 public:
  FigureTable(std::ostream& out, const std::vector<std::string>& columns)
      : out_(out), columns_(columns.size()) {
    out_ << "<div class=\"table\"><table>\n<thead><tr>";
    for (const std::string& name : columns) out_ << "<th>" << name << "</th>";
    out_ << "</tr></thead>\n<tbody>\n";
  }
  ~FigureTable() { out_ << "</tbody></table></div>\n"; }
  FigureTable(const FigureTable&) = delete;
  FigureTable& operator=(const FigureTable&) = delete;

  void group(const std::string& name) {
    out_ << "<tr class=\"group\"><th colspan=\"" << columns_ << "\">" << name << "</th></tr>\n";
  }
  void row(const std::string& name, const std::string& meaning, const std::vector<std::string>& values) {
    out_ << "<tr><td>" << name << "<small>" << meaning << "</small></td>";
    for (const std::string& value : values) out_ << "<td>" << value << "</td>";
    out_ << "</tr>\n";
  }

 private:
  std::ostream& out_;
  std::size_t columns_;
};

std::string card(const std::string& value, const std::string& meaning) {
  return "<div class=\"card\"><b>" + value + "</b><span>" + meaning + "</span></div>\n";
}

std::string degrees(const Figure& figure) { return figure_words(figure, {radians_to_degrees(1), "°"}); }

std::string verdict(const SurfaceComparison& c) {
  if (c.difference.rmse.value == 0) return "The two surfaces are the same, to the last bit.";
  std::string text = fmt::format(
      "The surfaces differ by {} (RMSE) and {} on average; {:.0f} % of the cells changed beyond doubt.",
      length_text(c.difference.rmse.value), length_text(std::abs(c.difference.bias.value)),
      100 * c.significant_share);
  if (std::isfinite(c.offset.value) && std::isfinite(c.a.wavelength.value))
    text +=
        fmt::format(" Ripples of the first lie {} {} those of the second.",
                    length_text(std::abs(c.offset.value)), c.offset.value >= 0 ? "downwind of" : "upwind of");
  if (c.skill)
    text += fmt::format(" As a forecast the first has a skill of {} against “nothing changes”.",
                        skill_text(c.skill->persistence.value));
  return text;
}

void write_difference(std::ostream& out, const ComparedSurfaces& compared) {
  const SurfaceComparison& c = compared.comparison;
  FigureTable table(out, {"First minus second", "figure ± standard error"});
  table.row("Bias", "mean difference; positive: the first is higher", {length_words(c.difference.bias)});
  table.row("RMSE", "root mean square", {length_words(c.difference.rmse)});
  table.row("NMAD", "spread that outliers do not sway", {length_words(c.difference.nmad)});
  table.row("LE90", "90 % of the cells differ by no more", {length_words(c.difference.le90)});
  table.group("Change beyond the level of detection (95 %)");
  table.row("Share of cells", escape_html(c.detection), {fmt::format("{:.1f} %", 100 * c.significant_share)});
  const double factor = compared.profile ? 1 / compared.b.geometry().cell() : 1;
  const Unit litres = compared.profile
                          ? Unit{1e4 * factor, "cm²"}
                          : volume_unit(std::abs(c.volume.gain.value) + std::abs(c.volume.loss.value));
  const char* thing = compared.profile ? "Area" : "Volume";
  table.row(std::string(thing) + " gained", "by the first over the second, where it is higher",
            {figure_words(c.volume.gain, litres)});
  table.row(std::string(thing) + " lost", "where it is lower", {figure_words(c.volume.loss, litres)});
  table.row("Net", "of all cells, without a threshold", {figure_words(c.volume.net, litres)});
  table.row("Cells that err as one", escape_html(c.correlation), {number_text(c.correlation_area)});
}

void write_patterns(std::ostream& out, const SurfaceComparison& c) {
  FigureTable table(out, {"Ripples along the wind", "first", "second"});
  const auto both = [](const Figure& a, const Figure& b) {
    return std::vector<std::string>{length_words(a), length_words(b)};
  };
  table.row("Wavelength", "crest to crest", both(c.a.wavelength, c.b.wavelength));
  table.row("Height", "trough to crest", both(c.a.height, c.b.height));
  table.row("Index", "wavelength over height",
            {figure_words(c.a.index, {1, ""}), figure_words(c.b.index, {1, ""})});
  table.row("Crest normal", "counter-clockwise from east",
            {degrees(c.a.crest_normal), degrees(c.b.crest_normal)});
  table.row("Dominant length", "first maximum of the length scales",
            both(c.a.scales.dominant, c.b.scales.dominant));
  table.group("Displacement of the pattern, downwind positive");
  table.row("First from second", "within half a wavelength: beyond, the pattern meets itself again",
            {length_words(c.offset), ""});
  table.row("Place by place", "median and spread of the windows",
            {std::isnan(c.crests.median)
                 ? "not available"
                 : length_text(c.crests.median) + ", spread " + length_text(c.crests.spread),
             ""});
  if (!c.skill) return;
  table.row("Since the initial surface", "", both(c.skill->migration_a, c.skill->migration_b));
  table.group("The first as a forecast of the second: 1 perfect, 0 as good as the baseline");
  const auto skill = [](const Figure& f) { return fmt::format("{:.3f} ± {:.3f}", f.value, f.sigma); };
  table.row("Skill against nothing changes", "baseline error " + length_text(c.skill->rmse_persistence),
            {skill(c.skill->persistence), ""});
  table.row("Skill against the best translation",
            "with hindsight, error " + length_text(c.skill->rmse_translation),
            {skill(c.skill->translation), ""});
}

void write_registration(std::ostream& out, const ComparedSurfaces& compared) {
  const CoRegistered& r = *compared.registered;
  out << "<h2>Co-registration</h2>\n<p>The first surface was moved onto the second (" << compared.method
      << ", "
      << (compared.stable_ground       ? "from stable ground only"
          : compared.method == "plane" ? "from all cells"
                                       : "from all cells: what all ripples have in common of their "
                                         "migration counts as a shift")
      << ").</p>\n";
  FigureTable table(out, {"Moved by", "figure ± standard error"});
  table.row("East", "", {length_words(r.east)});
  table.row("North", "", {length_words(r.north)});
  table.row("Up", "", {length_words(r.up)});
  table.row("Tilt eastwards, northwards", "mm per metre",
            {figure_words(r.tilt_east, {1000, ""}) + ", " + figure_words(r.tilt_north, {1000, ""})});
  table.row("Turn", "", {degrees(r.turn)});
  table.row("NMAD of the differences", "before, after",
            {length_text(r.nmad_before) + ", " + length_text(r.nmad_after)});
}

}  // namespace

void write_comparison_page(const ComparedSurfaces& compared, const std::vector<ComparisonPicture>& pictures,
                           const std::string& folder) {
  const SurfaceComparison& c = compared.comparison;
  const GridGeometry& grid = compared.b.geometry();
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>Two surfaces compared</title>\n<style>"
      << report_style
      << "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>Two surfaces compared</h1>\n<p "
         "class=\"source\">First: "
      << escape_html(compared.name_a) << "<br>Second: " << escape_html(compared.name_b)
      << (compared.name_start.empty() ? "" : "<br>Initial: " + escape_html(compared.name_start))
      << "</p>\n<p class=\"verdict\">" << escape_html(verdict(c))
      << "</p>\n</header>\n<div class=\"cards\">\n"
      << card(length_text(c.difference.rmse.value), "RMSE of first minus second")
      << card(length_text(c.difference.nmad.value), "NMAD")
      << card(fmt::format("{:.1f} %", 100 * c.significant_share), "of the cells differ beyond LoD95");
  if (std::isfinite(c.offset.value))
    out << card(length_text(c.offset.value), "crests of the first downwind of the second's");
  if (c.skill) out << card(skill_text(c.skill->persistence.value), "skill against “nothing changes”");
  out << "</div>\n<h2>The surfaces</h2>\n<p>" << grid.nx() << " × " << grid.ny() << " cells of "
      << length_text(grid.cell()) << "; the wind blows "
      << fmt::format("to {:.0f}° (counter-clockwise from east), from {:.0f}° (clockwise from north).",
                     radians_to_degrees(compared.direction),
                     meteorological_from_direction(compared.direction));
  for (const std::string& remark : compared.remarks) out << "<br>" << escape_html(remark);
  out << "</p>\n";
  std::size_t maps = 0;
  while (maps < pictures.size() && pictures[maps].file != "histogram.svg") ++maps;
  const auto write_pictures = [&](std::size_t from, std::size_t to) {
    const bool wide = from < to && pictures[from].wide;
    if (!wide) out << "<div class=\"maps\">\n";
    for (std::size_t i = from; i < to; ++i) out << picture(pictures[i], folder);
    if (!wide) out << "</div>\n";
  };
  write_pictures(0, maps);
  out << "<h2>How they differ</h2>\n";
  write_difference(out, compared);
  out << "<h2>Their ripples</h2>\n";
  write_patterns(out, c);
  out << "<h2>Distributions</h2>\n";
  write_pictures(maps, pictures.size());
  if (compared.registered) write_registration(out, compared);
  out << "<footer>Standard errors allow for neighbours that err alike; how each is had: "
         "docs/compare_surfaces.md. The "
         "numbers are in comparison.yaml, "
      << (compared.profile ? "difference.csv" : "difference.tif")
      << ", coherence.csv and scales.csv beside this page.</footer>\n</main>\n</body>\n</html>\n";
  write_text_atomically(folder + "/index.html", out.str());
}

}  // namespace aeolian
