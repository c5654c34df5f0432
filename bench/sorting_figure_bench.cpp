// Draws a vertical section through ripples of two sizes of grains into a folder: sorting_section.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/sorting_figure_bench docs

#include <algorithm>
#include <cmath>
#include <sstream>

#include "../test/aeolian_core/bedforms/sorting/sorted_experiments.hpp"
#include "draw_figures.hpp"
#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

constexpr double minutes = 20;
constexpr double mm = 1e-3;
constexpr int shown = 300;  ///< cells

SortedBed grown_bed() {
  const GridGeometry g(0, 0, 1 * mm, 480, 96);
  SortedRippleParameters p;
  p.ripples.border = Border::periodic;
  p.stratum = 0.5;
  p.strata = 64;
  Grain fine;
  fine.diameter = 0.3 * mm;
  SortedBed bed(g, rough_bed(g, 0.2 * mm), p.layers());
  SortedRippleModel(p).advance(bed, sorted_forcing(0.45, 0, fine, p.coarse_diameter), 60 * minutes);
  return bed;
}

void draw_section(const std::string& path) {
  const SortedBed bed = grown_bed();
  const GridGeometry& g = bed.geometry;
  const int y = g.ny() / 2;
  const auto [low, high] = std::minmax_element(bed.height.begin(), bed.height.end());
  const double bottom = *low - 4 * mm;
  const double top = *high + 1.5 * mm;
  Curve surface, fraction;
  for (int x = 0; x < shown; ++x) {
    const std::size_t cell = g.index(x, y);
    surface.x.push_back(g.x(x) / mm);
    surface.y.push_back(bed.height[cell] / mm);
    fraction.x.push_back(g.x(x) / mm);
    fraction.y.push_back(100 * bed.surface_fraction(cell));
  }
  std::ostringstream script;
  script << plot_style;
  write_data(script, "surface", surface);
  write_data(script, "fraction", fraction);
  // Columns of equal fraction are one box each.
  constexpr double dz = 0.1 * mm;
  script << "$section << EOD\n";
  for (int x = 0; x < shown; ++x) {
    const std::size_t cell = g.index(x, y);
    const double h = bed.height[cell];
    double from = bottom;
    double last = bed.fraction_at(cell, h - bottom);
    for (double z = bottom; z < h + dz; z += dz) {
      const double now = z < h ? bed.fraction_at(cell, h - z) : 2;
      if (std::abs(now - last) < 0.02) continue;
      script << fmt::format("{:.1f} {:.2f} {:.2f} {:.1f}\n", g.x(x) / mm, from / mm, std::min(z, h) / mm,
                            100 * last);
      from = z;
      last = now;
    }
  }
  script << "EOD\n"
         << "set multiplot\nset lmargin at screen 0.07\nset rmargin at screen 0.88\nunset key\n"
         << fmt::format("set xrange [0:{}]\n", shown * g.cell() / mm)
         << "set tmargin at screen 0.92\nset bmargin at screen 0.46\n"
         << fmt::format("set yrange [{}:{}]\n", bottom / mm, top / mm)
         << "set ylabel 'height [mm]'\nset format x ''\nset ytics 4\n"
         << "set cbrange [0:60]\nset cblabel 'coarse grains [% of volume]'\nset cbtics 20\n"
         << "set palette defined (0 '#f6ead2', 20 '#e0a03a', 40 '#a04418', 60 '#2e2723')\n"
         << fmt::format(
                "set title 'Ripples of 0.3 mm sand with a fifth of 0.6 mm grains after {:g} minutes of wind "
                "from the left, u_* = 0.45 m/s: section'\n",
                minutes)
         // Boxes are as wide as cells, and a little more, lest gaps show.
         << fmt::format(
                "plot $section using 1:3:($1-{0}):($1+{0}):2:3:4 with boxxyerror fs solid noborder "
                "lc palette, $surface using 1:2 with lines lw 1.5 lc rgb '#2e2723'\n",
                0.52 * g.cell() / mm)
         << "unset title\nunset colorbox\nset tmargin at screen 0.40\nset bmargin at screen 0.13\n"
         << "set yrange [0:80]\nset ytics 20\nset grid y\nset format x '%g'\n"
         << "set ylabel 'coarse at the surface [%]'\nset xlabel 'along the wind [mm]'\n"
         << "plot $fraction using 1:2 with lines lw 1.8 lc rgb '#a04418', 20 with lines dt 2 lc rgb "
            "'#6b6058'\nunset multiplot\n";
  plot_svg(script.str(), 1200, 560, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("sorting_figure_bench", argc, argv, [](const std::string& folder) {
    aeolian::draw_section(folder + "/sorting_section.svg");
  });
}
