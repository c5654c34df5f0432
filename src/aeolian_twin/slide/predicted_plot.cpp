#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/slide/slide_studies.hpp"

namespace aeolian {
namespace {

constexpr int folds = 10;

struct Panel {
  const char* name;
  const char* label;
  double (*number)(const PileRecord&);
  const SlideSurrogate::Target& target;
};

/// Places of the piles, and the band in which the interval lies.
void write_panel(std::ostream& script, const Panel& panel, const PileTable& table, std::uint64_t seed) {
  const TrainingRows rows = rows_of(table, panel.number);
  const auto predicted =
      out_of_fold(rows, grouped_folds(rows.runs, folds, seed), panel.target.vectors.parts().settings);
  Curve points;
  double most = 0;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    points.x.push_back(std::exp(rows.targets[k]));
    points.y.push_back(std::exp(predicted[k]));
    most = std::max({most, points.x.back(), points.y.back()});
  }
  write_data(script, panel.name, points);
  const double factor = std::exp(panel.target.half_width);
  script << fmt::format("set title '{0}' textcolor rgb measured\nset xrange [0:{1}]\nset yrange [0:{1}]\n",
                        panel.label, 1.05 * most)
         << "set xlabel 'simulated'\nset ylabel 'predicted'\n"
         << fmt::format(
                "plot '+' using 1:($1/{0}):($1*{0}) with filledcurves fc rgb '#e3e9f2' notitle, "
                "x with lines lw 1 lc rgb '#888888' notitle, ${1} using 1:2 with points pt 7 ps 0.5 lc "
                "rgb forecast notitle\n",
                factor, panel.name);
}

}  // namespace

void plot_predicted(const PileTable& table, const SlideSurrogate& surrogate, std::uint64_t seed,
                    const std::string& file) {
  const Panel panels[] = {
      {"height", "height of the pile [m]", [](const PileRecord& r) { return r.height; }, surrogate.height()},
      {"length", "length of the pile [m]", [](const PileRecord& r) { return r.length; }, surrogate.length()},
      {"shape", "height over length", [](const PileRecord& r) { return r.shape(); }, surrogate.shape()}};
  std::ostringstream script;
  script << plot_style << "unset key\nset size square\nset multiplot layout 1,3\n";
  for (const Panel& panel : panels) write_panel(script, panel, table, seed);
  script << "unset multiplot\n";
  plot_svg(script.str(), 1200, 420, file);
}

}  // namespace aeolian
