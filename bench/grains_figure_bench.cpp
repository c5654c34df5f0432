// Draws what steps and stiffness do to grain dynamics into a folder: grains_step.svg and
// grains_stiffness.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/grains_figure_bench docs/accuracy

#include <sstream>

#include "draw_figures.hpp"
#include "grains_convergence.hpp"
#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

void draw_steps(const std::string& path) {
  Curve all, half;
  for (const double steps : {9, 13, 18, 25, 36, 51, 72, 102, 144, 204, 288, 407, 576, 815, 1152}) {
    const StepError error = error_of_step(steps);
    all.x.push_back(steps);
    all.y.push_back(error.root_mean_square);
    half.x.push_back(steps);
    half.y.push_back(error.median);
  }
  std::ostringstream script;
  script << plot_style;
  write_data(script, "all", all);
  write_data(script, "half", half);
  script
      << "set logscale xy\nset format y '10^{%T}'\nset grid x y\nset xrange [7:1500]\nset xtics (9, 18, 36, "
         "72, 144, 288, 576, 1152)\nset xlabel 'steps in a contact'\nset ylabel 'error of the restitution'\n"
      << "set title 'Restitution of table 2.1, contacts that begin anywhere in a step'\nset key top right\n"
      << "plot $all with linespoints lw 2 pt 7 lc rgb '#c2571a' title 'root mean square', "
         "$half with linespoints lw 2 pt 5 lc rgb '#3c6e9f' title 'median', "
         "6.0 / x**2 with lines dt 2 lw 1.5 lc rgb '#8a8f98' title 'second order'\n";
  plot_svg(script.str(), 760, 420, path);
}

void draw_stiffness(const std::string& path) {
  const double stiffness[] = {6e4, 1.9e5, 6e5, 1.9e6, 6e6, 1.9e7, 6e7};
  std::ostringstream script;
  script << plot_style << "$rebounds << EOD\n";
  for (const double k : stiffness) {
    const Rebound r = rebound_of_stiffness(k, 160);
    script << fmt::format("{} {} {} {} {} {}\n", k, r.along, r.along_error, r.up, r.up_error, r.seconds);
  }
  script << "EOD\nset multiplot layout 1,2\nset logscale x\nset format x '10^{%T}'\nset grid x y\n"
         << "set xrange [3e4:1.2e8]\nset xlabel 'stiffness [N/m]'\n"
         << "set arrow from 6e6, graph 0 to 6e6, graph 1 nohead dt 2 lc rgb '#8a8f98'\n"
         << "set label 'thesis' at 5e6, graph 0.06 right tc rgb '#8a8f98'\n"
         << "set ylabel 'speed after over before the impact'\nset yrange [0.5:1.1]\nset key bottom left\n"
         << "set title 'Mean rebound of 160 impacts'\n"
         << "plot $rebounds using 1:4:5 with yerrorlines lw 2 pt 5 lc rgb '#3c6e9f' title 'vertical', "
            "$rebounds using 1:2:3 with yerrorlines lw 2 pt 7 lc rgb '#c2571a' title 'horizontal'\n"
         << "set ylabel 'processor time of an impact [ms]'\nset logscale y\nset yrange [1:100]\nunset key\n"
         << "set title 'What stiff grains cost'\n"
         << "plot $rebounds using 1:(1000*$6/160) with linespoints lw 2 pt 7 lc rgb '#2e2723'\n"
         << "unset multiplot\n";
  plot_svg(script.str(), 1000, 420, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("grains_figure_bench", argc, argv, [](const std::string& folder) {
    aeolian::draw_steps(folder + "/grains_step.svg");
    aeolian::draw_stiffness(folder + "/grains_stiffness.svg");
  });
}
