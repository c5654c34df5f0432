#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/slide/slide_files.hpp"

namespace aeolian {
namespace {

/// The pile's top along x at y = 0, where there is snow.
template <int Dim>
Curve profile_of(const SlideConfig& config, const std::vector<MaterialPoint<Dim>>& snow) {
  const HeightMap map = pile_map<Dim>(config.scene, snow, config.scene.cell);
  const GridGeometry& geometry = map.geometry();
  const auto middle = geometry.find(geometry.x(0), 0);
  const int row = middle ? middle->y : geometry.ny() / 2;
  Curve curve;
  for (int x = 0; x < geometry.nx(); ++x) {
    curve.x.push_back(geometry.x(x));
    curve.y.push_back(map.layer(layer::elevation)[geometry.index(x, row)]);
  }
  return curve;
}

/// From pale to dark, the last event the darkest.
std::string shade(std::size_t k, std::size_t count) {
  const double share = count < 2 ? 1 : static_cast<double>(k) / static_cast<double>(count - 1);
  const auto mix = [&](double from, double to) { return static_cast<int>(from + share * (to - from)); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(168, 18), mix(200, 52), mix(226, 96));
}

}  // namespace

template <int Dim>
void plot_piles(const SlideConfig& config, const std::vector<KeptEvent<Dim>>& events,
                const std::string& folder) {
  std::ostringstream script;
  script << plot_style
         << fmt::format("set title '{}: the pile after each event' textcolor rgb measured\n", config.name)
         << "set xlabel 'x from under the middle of the panel [m]'\nset ylabel 'height [m]'\n"
         << "set size ratio -1\nset yrange [0:*]\nset key top right\n";
  const auto panel = panel_frame<2>(config.scene);
  const Point<2> half = 0.5 * config.scene.panel_length * panel.axes.col(0);
  Curve edge;
  for (const double side : {-1., 1.}) {
    edge.x.push_back(panel.centre[0] + side * half[0]);
    edge.y.push_back(panel.centre[1] + side * half[1]);
  }
  write_data(script, "panel", edge);
  std::string plots = "$panel using 1:2 with lines lw 4 lc rgb '#8a8f98' title 'panel'";
  for (std::size_t k = events.size(); k-- > 0;) {
    const std::string name = fmt::format("event{}", k);
    write_data(script, name, profile_of<Dim>(config, events[k].event.snow));
    plots += fmt::format(", ${} using 1:2 with lines lw 2 lc rgb '{}' title 'event {}'", name,
                         shade(k, events.size()), events[k].event.number);
  }
  script << "plot " << plots << "\n";
  plot_svg(script.str(), 1000, 520, folder + "/profiles.svg");

  Curve height, length;
  for (const auto& kept : events) {
    for (Curve* c : {&height, &length}) c->x.push_back(kept.event.number);
    height.y.push_back(kept.event.pile.height);
    length.y.push_back(kept.event.pile.length);
  }
  std::ostringstream growth;
  growth << plot_style << "set multiplot layout 1,2\nunset key\nset yrange [0:*]\nset xlabel 'event'\n"
         << fmt::format("set xrange [0.5:{}.5]\nset xtics 1\n", events.size());
  write_data(growth, "height", height);
  write_data(growth, "length", length);
  growth << "set ylabel 'height of the pile [m]'\nplot $height using 1:2 with linespoints pt 7 lw 2 lc rgb "
            "forecast\n"
         << "set ylabel 'length of the pile [m]'\nplot $length using 1:2 with linespoints pt 7 lw 2 lc rgb "
            "second\n"
         << "unset multiplot\n";
  plot_svg(growth.str(), 900, 360, folder + "/growth.svg");
}

template void plot_piles(const SlideConfig&, const std::vector<KeptEvent<2>>&, const std::string&);
template void plot_piles(const SlideConfig&, const std::vector<KeptEvent<3>>&, const std::string&);

}  // namespace aeolian
