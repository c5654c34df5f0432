// Draws the error of the wind over a hill against its run time into a folder: wind_time.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/wind_figure_bench docs/accuracy

#include <cmath>
#include <ctime>
#include <functional>
#include <sstream>

#include "../test/aeolian_core/wind/relief_worlds.hpp"
#include "draw_figures.hpp"
#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

constexpr double length = 100;  ///< half-width of the hill, radius of the hemisphere [m]
constexpr double low = 0.05;    ///< height of the hill over it

struct Scene {
  std::function<double(double, double)> height;
  double speed_up;  ///< exact, at the crest
};
const Scene hill{[](double x, double y) { return gaussian(std::hypot(x, y), low * length, length); },
                 0.738 * low};
const Scene dome{[](double x, double y) { return std::sqrt(std::max(0.0, length * length - x * x - y * y)); },
                 0.5};

/// Adds the processor time and the error of the speed-up at the crest.
template <class Solve>
void add(Curve& curve, const Scene& scene, int n, Solve&& solve) {
  const HeightMap map = world(n, n, 8 * length / n, scene.height);
  double best = 1e300;
  double ours = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const std::clock_t start = std::clock();
    ours = solve(wind_relief(map, 0)) - 1;
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  curve.x.push_back(best);
  curve.y.push_back(100 * std::abs(ours / scene.speed_up - 1));
}

void draw(const std::string& path) {
  const UpwindProfile uniform = UpwindProfile::uniform();
  Curve curves[5];
  for (const int n : {24, 48, 96, 192}) {
    int c = 0;
    for (const Scene* scene : {&hill, &dome}) {
      add(curves[c++], *scene, n, [&](const WindRelief& relief) {
        return SpectralVolume(relief, 0, uniform, attached, 0.1 * length).velocity(0, 0, 0.1).east;
      });
      add(curves[c++], *scene, n, [&](const WindRelief& relief) {
        const std::size_t boxes = static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * 44 + 20000;
        return MassConsistentVolume(relief, 0, uniform, {std::min<std::size_t>(boxes, 400000), 1})
            .velocity(0, 0, 0.1)
            .east;
      });
    }
  }
  curves[4].x = {1e-6};
  curves[4].y = {100};
  std::ostringstream script;
  script << plot_style;
  for (int c = 0; c < 5; ++c) write_data(script, fmt::format("c{}", c), curves[c]);
  script
      << "set logscale xy\nset format x '10^{%T}'\nset grid x y\nset xrange [3e-7:20]\nset yrange [0.1:300]\n"
      << "set xlabel 'processor time of one direction [s]'\nset ylabel 'error of the speed-up at the crest "
         "[%]'\n"
      << "set key outside right top\nset title 'Wind over a hill, H/L = 0.05, and over a hemisphere'\n"
      << "plot $c0 with linespoints lw 2 pt 7 lc rgb '#c2571a' title 'spectral, hill', "
         "$c1 with linespoints lw 2 pt 5 lc rgb '#3c6e9f' title 'mass consistent, hill', "
         "$c2 with linespoints lw 2 dt 2 pt 6 lc rgb '#c2571a' title 'spectral, hemisphere', "
         "$c3 with linespoints lw 2 dt 2 pt 4 lc rgb '#3c6e9f' title 'mass consistent, hemisphere', "
         "$c4 with points pt 2 ps 1.6 lw 2 lc rgb '#2e2723' title 'log law, both'\n";
  plot_svg(script.str(), 960, 460, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("wind_figure_bench", argc, argv,
                               [](const std::string& folder) { aeolian::draw(folder + "/wind_time.svg"); });
}
