// Draws where snow moves, over the wind's speed and the time since the snow fell, into a folder:
// erosion_bonds.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/erosion_figure_bench docs/accuracy

#include <sstream>

#include "draw_figures.hpp"
#include "erosion_bond_map.hpp"
#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

/// A panel: circles are the cases, full where snow moves, red where Bertholet says otherwise.
void draw_panel(std::ostringstream& script, const std::string& name, const std::string& title,
                const std::vector<std::vector<bool>>& moves) {
  script << '$' << name << " << EOD\n";
  int right = 0, all = 0;
  for (std::size_t w = 0; w < snow_winds.size(); ++w)
    for (std::size_t a = 0; a < snow_ages.size(); ++a) {
      const bool agrees = moves[w][a] == bertholet_moves(snow_winds[w], snow_ages[a]);
      right += agrees ? 1 : 0;
      ++all;
      script << fmt::format("{} {} {} {}\n", snow_ages[a], snow_winds[w], moves[w][a] ? 7 : 6,
                            agrees ? "0x3c6e9f" : "0xc2401a");
    }
  script << "EOD\nset title " << fmt::format("'{}: {} of {} cases right'\n", title, right, all);
  script << "plot $" << name
         << " using 1:2:3:4 with points pt variable ps 1.3 lw 1.5 lc rgb variable notitle\n";
}

void draw_bonds(const std::string& path) {
  const double exponent = SnowBonding{}.exponent;
  std::vector<std::vector<bool>> blown, calm;
  SnowBonding snow;
  snow.temperature = -20;
  for (const double wind : snow_winds) {
    blown.emplace_back();
    calm.emplace_back();
    const std::vector<double> flux = flux_with_age(wind, exponent);
    const double friction = wind_at_ten_metres(wind, snow_roughness).friction_velocity;
    for (std::size_t a = 0; a < snow_ages.size(); ++a) {
      blown.back().push_back(flux[a] > 0.05);
      calm.back().push_back(friction > snow_threshold(snow, 3600 * snow_ages[a]));
    }
  }
  std::ostringstream script;
  script << plot_style
         << "set multiplot layout 1,2\nset logscale x\nset xrange [0.005:250]\nset yrange [4:16]\n"
         << "set xtics ('1 min' 0.0167, '1 h' 1, '6 h' 6, '1 d' 24, '4 d' 96)\nset ytics 5,2,15\n"
         << "set xlabel 'age of the snow'\nset ylabel 'wind at 10 m [m/s]'\n"
         << "set object 1 rectangle from 0.005,8 to 24,16 fillcolor rgb '#e8eef4' fillstyle solid noborder "
            "behind\n"
         << "set label 1 'moves (Bertholet)' at 0.007,15.5 tc rgb '#5a6470'\n"
         << "set label 2 'stationary' at 32,4.6 tc rgb '#5a6470'\n";
  draw_panel(script, "blown", "wind since the snow fell, model", blown);
  draw_panel(script, "calm", "undisturbed until then, threshold", calm);
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 440, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("erosion_figure_bench", argc, argv, [](const std::string& folder) {
    aeolian::draw_bonds(folder + "/erosion_bonds.svg");
  });
}
