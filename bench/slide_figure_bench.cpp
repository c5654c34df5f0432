// Draws what slide_forecaster makes of a live map into a folder: slide_forecaster.png, the map with the pile
// of three slabs, and slide_forecaster.svg, the piles along their middle.
//
//     catkin_ws/devel/lib/aeolian_twin/slide_figure_bench docs

#include <cmath>
#include <sstream>
#include <vector>

#include "draw_figures.hpp"
#include <fmt/format.h>

#include "aeolian_core/slide/slide.hpp"
#include "aeolian_core/surface/preview.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

constexpr double model_error = 0.2;

/// Ground that falls to the east and has furrows, as measured to 2 mm.
HeightMap furrows() {
  HeightMap map(GridGeometry(-0.2, -0.25, 0.004, 225, 125));
  const GridGeometry& grid = map.geometry();
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const double x = grid.x(grid.cell_at(k).x), y = grid.y(grid.cell_at(k).y);
    elevation[k] = static_cast<float>(-0.05 * x + 0.006 * std::sin(2 * M_PI * (x + 0.4 * y) / 0.12));
  }
  map.add(layer::variance, 4e-6F);
  return map;
}

/// As height_mapper does.
void put(const HeightMap& patch, HeightMap& map) {
  const GridGeometry& from = patch.geometry();
  for (std::size_t k = 0; k < from.size(); ++k) {
    const CellIndex at = from.cell_at(k);
    const auto there = map.geometry().find(from.x(at.x), from.y(at.y));
    if (!there || !std::isfinite(patch.layer(layer::elevation)[k])) continue;
    for (const std::string& name : {layer::elevation, layer::variance})
      map.layer(name)[map.geometry().index(*there)] = patch.layer(name)[k];
  }
}

/// Place along the slide, elevation and its standard deviation, in mm.
std::string along_middle(const HeightMap& patch) {
  std::string text;
  const GridGeometry& grid = patch.geometry();
  const auto middle = grid.find(grid.x(0), 0);
  for (int x = 0; x < grid.nx(); ++x) {
    const std::size_t k = grid.index(x, middle->y);
    if (std::isfinite(patch.layer(layer::elevation)[k]))
      text += fmt::format("{:.2f} {:.2f} {:.2f}\n", 1e3 * grid.x(x),
                          1e3 * static_cast<double>(patch.layer(layer::elevation)[k]),
                          1e3 * std::sqrt(static_cast<double>(patch.layer(layer::variance)[k])));
  }
  return text;
}

void draw(const std::string& folder) {
  SlideScene scene;
  scene.threads = 1;
  const auto piles = make_site_piles(scene, {}, 2, model_error);
  HeightMap map = furrows();
  std::ostringstream script;
  script << plot_style << "$ground << EOD\n" << along_middle(map) << "EOD\n";
  std::string plot;
  const std::vector<std::string> colours{"#9ecae1", "#4a90c2", "#08519c"};
  for (int event = 1; event <= 3; ++event) {
    const auto pile = piles->release(map, scene.slab_thickness);
    put(pile->patch, map);
    script << fmt::format("$pile{} << EOD\n{}EOD\n", event, along_middle(pile->patch));
    const std::string& colour = colours[static_cast<std::size_t>(event - 1)];
    plot += fmt::format(
        ", $pile{0} using 1:($2-$3):($2+$3) with filledcurves lc rgb '{1}' fs transparent solid 0.25 "
        "notitle, "
        "$pile{0} using 1:2 with lines lw 2 lc rgb '{1}' title 'after slab {0} (band: one standard "
        "deviation)'",
        event, colour);
  }
  const double half_x = 500 * scene.panel_length * std::cos(scene.tilt);
  const double half_z = 500 * scene.panel_length * std::sin(scene.tilt);
  script << fmt::format(
      "set arrow from {:.1f},{:.1f} to {:.1f},{:.1f} nohead lw 5 lc rgb '#555555'\n"
      "set label 'panel' at {:.1f},{:.1f} left offset 1,0\n",
      -half_x, 1e3 * scene.panel_height + half_z, half_x, 1e3 * scene.panel_height - half_z, 0.0,
      1e3 * scene.panel_height + 15);
  script << "set title 'Three slabs of 2 cm slide off a panel onto the measured ground'\n"
            "set xlabel 'along the slide, from the middle of the panel [mm]'\nset ylabel 'height [mm]'\n"
            "set size ratio -1\nset xrange [-150:700]\nset yrange [-60:430]\nset key top right\nset grid y\n"
            "plot $ground using 1:2 with lines lw 2 lc rgb '#6b6058' title 'ground, as the map had it'"
         << plot << "\n";
  plot_svg(script.str(), 900, 560, folder + "/slide_forecaster.svg");
  PreviewOptions options;
  options.title = "Live map after three slabs (panel at the left, snow slides to the right)";
  write_preview(map, folder + "/slide_forecaster.png", options);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("slide_figure_bench", argc, argv, aeolian::draw);
}
