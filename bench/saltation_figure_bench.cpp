// Draws the error of saltation against its run time: docs/accuracy/saltation_time.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/saltation_figure_bench docs/accuracy/saltation_time.svg

#include <cstdio>
#include <map>
#include <sstream>

#include "saltation_convergence.hpp"

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

void draw(const std::string& path) {
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

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  // Among all benchmarks, without a path, there is nothing to do.
  if (argc < 2) return 0;
  try {
    aeolian::draw(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "saltation_figure_bench: %s\n", error.what());
    return 1;
  }
}
