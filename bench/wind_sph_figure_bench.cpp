// Draws the air of particles over a ridge, seen from the side, into a folder: wind_sph.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/wind_sph_figure_bench docs

#include <cmath>
#include <sstream>

#include "../test/aeolian_core/wind/sph/air_box.hpp"
#include "draw_figures.hpp"

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

constexpr int length = 72;
constexpr int height = 24;
constexpr double crest = 5;
double ridge_height(double x) { return gaussian(x, crest, 6); }

void draw(const std::string& path) {
  const sph::AirBox box(ridge(length, 1, ridge_height), length, 8, height, 5, 0);
  sph::SphAir air = box.air();
  while (air.time() < length) air.step();
  std::ostringstream script;
  script << plot_style << "$air << E\n";
  for (std::size_t i = 0; i < air.size(); ++i) {
    const sph::Four& u = air.motion()[i];
    if (air.place()[i][1] > 1.5F) continue;  // A slice.
    script << air.place()[i][0] - length / 2 << ' ' << air.place()[i][2] << ' ' << std::sqrt(sph::dot3(u, u))
           << '\n';
  }
  script << "E\n$ground << E\n";
  for (double x = -length / 2.0; x <= length / 2.0; x += 0.25)
    script << x << ' ' << static_cast<double>(air.ground().height(static_cast<float>(x + length / 2.0), 4))
           << '\n';
  script << "E\nset size ratio -1\nset xrange [" << -length / 2 << ':' << length / 2
         << "]\nset yrange [0:" << height << "]\n"
         << "set xlabel 'along the wind (to the right) [spacings of particles]'\nset ylabel 'height'\n"
         << "set palette defined (0.6 '#31688e', 1 '#e8e4da', 1.4 '#c2571a')\nset cbrange [0.6:1.4]\n"
         << "set cblabel 'speed [that of the surroundings]'\nunset key\n"
         << "set title 'Air of particles over a ridge; beyond the dashed lines the ring gives the wind'\n"
         << "set arrow 1 from " << -length / 2 + 5 << ",0 to " << -length / 2 + 5 << ',' << height
         << " nohead dt 2 lc rgb '#2e2723'\nset arrow 2 from " << length / 2 - 5 << ",0 to " << length / 2 - 5
         << ',' << height << " nohead dt 2 lc rgb '#2e2723'\n"
         << "plot $air using 1:2:3 with points pt 7 ps 0.7 palette, "
            "$ground using 1:2 with filledcurves y1=0 lc rgb '#b8a888', $ground using 1:2 with lines lw 2 lc "
            "rgb "
            "'#2e2723'\n";
  plot_svg(script.str(), 960, 400, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("wind_sph_figure_bench", argc, argv,
                               [](const std::string& folder) { aeolian::draw(folder + "/wind_sph.svg"); });
}
