// Draws what the sample of the noise of single grains costs and errs by into a folder: ripple_shares.svg.
//
//     catkin_ws/devel/lib/aeolian_twin/ripple_figure_bench docs

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <vector>

#include "draw_figures.hpp"
#include "windy_sand.hpp"
#include <fmt/format.h>

#include "aeolian_core/bedforms/bedforms.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

constexpr int beds = 24;
constexpr double seconds = 300;

/// Of beds that began flat: mean square height with its standard error, and processor time per bed [s].
struct Sample {
  double share = 0, square = 0, error = 0, time = 0;
};

Sample sample(double share) {
  const GridGeometry g(0, 0, 0.002, 250, 128);
  const Forcing forcing = windy_sand();
  RippleParameters p;
  p.border = Border::periodic;
  p.stochastic_share = share;
  std::vector<double> squares;
  const std::clock_t start = std::clock();
  for (int bed = 0; bed < beds; ++bed) {
    p.seed = static_cast<std::uint64_t>(bed) + 1;
    std::vector<double> h(g.size(), 0.0);
    RippleModel(p).advance(g, h, forcing, seconds);
    double square = 0;
    for (const double z : h) square += z * z / static_cast<double>(h.size());
    squares.push_back(square);
  }
  Sample result{share, 0, 0, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / beds};
  for (const double s : squares) result.square += s / beds;
  for (const double s : squares) result.error += std::pow(s - result.square, 2);
  result.error = std::sqrt(result.error / (beds * (beds - 1)));
  return result;
}

void draw_shares(const std::string& path) {
  std::vector<Sample> samples;
  for (const double share : {1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) samples.push_back(sample(share));
  const Sample& whole = samples.front();
  std::ostringstream script;
  script << plot_style << "$shares << EOD\n";
  for (const Sample& s : samples)
    script << fmt::format("{:.3f} {:.4f} {:.4f} \"{:g} %\"\n", 1e3 * s.time,
                          100 * (s.square / whole.square - 1), 100 * s.error / whole.square, 100 * s.share);
  script << "EOD\nunset key\nset grid y\n"
         << fmt::format(
                "set title 'Noise of single grains drawn by a share of the cells: 5 min from a "
                "flat bed of 250 x 128 cells, means of {}'\n",
                beds)
         << "set xlabel 'processor time [ms]'\n"
         << "set ylabel 'mean square height, off that of all cells [%]'\nset offsets graph 0.05, graph 0.08, "
            "graph 0.1, graph 0.1\n"
         << "plot 0 with lines dt 2 lc rgb '#6b6058', $shares using 1:2:3 with yerrorbars pt 7 ps 0.8 lw 1.6 "
            "lc rgb '#a04418', $shares using 1:2:4 with labels offset 2.4,0.8\n";
  plot_svg(script.str(), 900, 480, path);
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::draw_figures("ripple_figure_bench", argc, argv, [](const std::string& folder) {
    aeolian::draw_shares(folder + "/ripple_shares.svg");
  });
}
