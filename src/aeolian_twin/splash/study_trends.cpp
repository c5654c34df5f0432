#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/photo/plot_panel.hpp"
#include "aeolian_twin/splash/study_plots.hpp"

namespace aeolian {
namespace {

constexpr std::array<const char*, 6> colours = {"#7a1f5c", "#c2571a", "#d9a441",
                                                "#3c6e9f", "#2f7d5b", "#8a8f98"};

/// Curves by what stays the same along each: the kind of bed, and an angle or a speed.
using Curves = std::map<std::pair<std::size_t, double>, Curve>;

void add(Curves& curves, std::size_t kind, double parameter, double x, const MeanValue& value) {
  if (!std::isfinite(value.mean)) return;
  Curve& curve = curves[{kind, parameter}];
  const double error = std::isfinite(value.error) ? value.error : 0;
  curve.x.push_back(x);
  curve.y.push_back(value.mean);
  curve.lower.push_back(value.mean - error);
  curve.upper.push_back(value.mean + error);
}

void plot(std::ostream& script, const std::string& panel, const Curves& curves, const std::string& unit) {
  std::map<double, std::size_t> colour_of;
  for (const auto& entry : curves) colour_of.emplace(entry.first.second, 0);
  std::size_t next = 0;
  for (auto& entry : colour_of) entry.second = next++;
  std::string plots;
  std::size_t i = 0;
  for (const auto& [key, curve] : curves) {
    const std::string name = fmt::format("{}{}", panel, i++);
    write_data(script, name, curve);
    const char* colour = colours[colour_of[key.second] % colours.size()];
    const std::string title = key.first == 0 ? fmt::format("title '{:.3g} {}'", key.second, unit) : "notitle";
    plots += fmt::format(
        "{}${} using 1:2:3:4 with yerrorbars lw 1 ps 0 lc rgb '{}' notitle, ${} using 1:2 with linespoints "
        "lw 1.8 pt 7 ps "
        "0.5 dt {} lc rgb '{}' {}",
        plots.empty() ? "plot " : ", ", name, colour, name, key.first + 1, colour, title);
  }
  script << plots << "\n";
}

}  // namespace

void plot_trends(const std::vector<StudyPoint>& points, double diameter, const std::string& title,
                 const std::string& path) {
  const double unit = std::sqrt(gravity * diameter);
  double ratio = points.front().size_ratio;
  for (const StudyPoint& point : points)
    if (std::abs(std::log(point.size_ratio)) < std::abs(std::log(ratio))) ratio = point.size_ratio;
  Curves number, speed, restitution, up;
  for (const StudyPoint& point : points) {
    if (point.size_ratio != ratio) continue;
    const double angle = point.angle / degree;
    const ImpactStatistics& s = point.statistics;
    add(number, point.kind, angle, point.speed / unit, s.number);
    MeanValue scaled = s.ejecta_speed;
    scaled.mean /= unit;
    scaled.error /= unit;
    add(speed, point.kind, angle, point.speed / unit, scaled);
    add(restitution, point.kind, point.speed / unit, angle, s.speed);
    add(up, point.kind, point.speed / unit, angle, s.up);
  }
  std::ostringstream script;
  script << plot_style << "set multiplot layout 2,2\nset label 1 " << quoted(title)
         << " at screen 0.06, screen 0.965 left noenhanced font ',17' textcolor rgb measured\nset yrange "
            "[0:*]\n";
  const auto panel = [&](int place, const std::string& x, const std::string& y, const char* key) {
    script << panel_place(place % 2 ? 0.57 : 0.08, place % 2 ? 0.97 : 0.48, place < 2 ? 0.88 : 0.41,
                          place < 2 ? 0.57 : 0.10)
           << "set xrange [0:*]\nset xlabel " << quoted(x) << "\nset ylabel " << quoted(y) << "\nset key "
           << key << " samplen 1.5\n";
  };
  panel(0, "impact speed [√(g d)]", "ejecta per impact", "top left");
  plot(script, "number", number, "°");
  script << "unset label\n";
  panel(1, "impact speed [√(g d)]", "mean ejecta speed [√(g d)]", "bottom right");
  plot(script, "speed", speed, "°");
  panel(2, "impact angle from the horizontal [°]", "rebound speed over impact speed", "bottom left");
  plot(script, "restitution", restitution, "√(g d)");
  panel(3, "impact angle from the horizontal [°]", "vertical speed, out over in", "top right");
  plot(script, "up", up, "√(g d)");
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 760, path);
}

}  // namespace aeolian
