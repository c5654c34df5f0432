// Draws the error of saltation against its run time and against its grids into a folder: saltation_time.svg
// and saltation_grid.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/saltation_figure_bench docs/accuracy

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "draw_figures.hpp"
#include "saltation_convergence.hpp"
#include "saltation_grid.hpp"

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

void draw_time(const std::string& path) {
  std::map<std::string, Curve> curves;
  for (const Convergence& c : measure_convergence()) {
    std::string name = c.way;
    if (name == "solver") name += ", " + c.setting.substr(0, c.setting.find(' '));
    curves[name].x.push_back(1e-3 * c.milliseconds);
    curves[name].y.push_back(100 * c.flux_error);
  }
  std::ostringstream script;
  script << plot_style << "set logscale xy\nset format x '10^{%T}'\nset grid x y\nset xrange [1e-10:0.1]\n"
         << "set yrange [0.005:2]\nset xlabel 'processor time of one state [s]'\n"
         << "set ylabel 'error of the flux [%]'\nset key outside right top\n"
         << "set title 'Case 1, u_* = 75 cm/s: what a state costs'\n";
  const char* const colours[] = {"#2e2723", "#c2571a", "#e0a03a", "#3c6e9f", "#6b8e4e", "#8a8f98"};
  std::string plots;
  int n = 0;
  for (const auto& [name, curve] : curves) {
    write_data(script, fmt::format("c{}", n), curve);
    plots += fmt::format("{}$c{} with linespoints lw 2 pt {} ps 1.1 lc rgb '{}' title '{}'", n ? ", " : "", n,
                         5 + 2 * (n % 3), colours[n % 6], name);
    ++n;
  }
  script << "plot " << plots << "\n";
  plot_svg(script.str(), 900, 460, path);
}

void draw_grids(const std::string& path) {
  struct Panel {
    Curve surface, flux, usual;
  };
  std::map<std::string, Panel> panels;
  for (const GridError& e : measure_grids()) {
    Panel& panel = panels[e.grid];
    for (const auto& [curve, error] :
         {std::pair{&panel.surface, e.surface}, std::pair{&panel.flux, e.flux}}) {
      curve->x.push_back(e.size);
      curve->y.push_back(100 * error);
      if (!e.usual) continue;
      panel.usual.x.push_back(e.size);
      panel.usual.y.push_back(100 * error);
    }
  }
  std::ostringstream script;
  script << plot_style
         << "set logscale xy\nset format y '10^{%T}'\nset grid x y\nset offsets graph 0.05, graph 0.05, "
            "graph 0, graph 0\n"
         << "set ylabel 'error [%]'\nset multiplot layout 2,2\n";
  int n = 0;
  for (const auto& [grid, panel] : panels) {
    write_data(script, fmt::format("s{}", n), panel.surface);
    write_data(script, fmt::format("q{}", n), panel.flux);
    write_data(script, fmt::format("u{}", n), panel.usual);
    const auto [least, most] = std::minmax_element(panel.flux.x.begin(), panel.flux.x.end());
    std::string tics;
    for (const double size : panel.flux.x)
      tics += fmt::format(
          "{}'{}' {}", tics.empty() ? "" : ", ",
          size < 0.1 ? fmt::format("10^{{{:g}}}", std::log10(size)) : fmt::format("{:g}", size), size);
    const bool falls = panel.flux.x.front() < panel.flux.x.back();
    script << fmt::format("set xlabel '{}'\nset xrange [{}:{}]\nset xtics ({})\n{}\n", grid, *least / 1.6,
                          *most * 1.6, tics, falls ? "set key top right" : "unset key")
           << fmt::format(
                  "plot $q{0} with linespoints lw 2 pt 7 lc rgb '#c2571a' title 'flux', $s{0} with "
                  "linespoints lw 2 "
                  "pt 5 lc rgb '#3c6e9f' title 'wind at the bed', $u{0} with points pt 6 ps 2.4 lw 2 lc rgb "
                  "'#2e2723' title 'as solved by default'\n",
                  n);
    ++n;
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 760, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("saltation_figure_bench", argc, argv, [](const std::string& folder) {
    aeolian::draw_time(folder + "/saltation_time.svg");
    aeolian::draw_grids(folder + "/saltation_grid.svg");
  });
}
