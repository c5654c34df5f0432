#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/photo/plot_panel.hpp"
#include "aeolian_twin/splash/study_plots.hpp"

namespace aeolian {
namespace {

/// Values of grains of some kinds, counted in bins, one row a kind.
class StackedHistogram {
 public:
  StackedHistogram(std::size_t kinds, double low, double high, int bins)
      : low_(low),
        width_((high - low) / bins),
        counts_(kinds, std::vector<double>(static_cast<std::size_t>(bins))) {}

  void add(std::size_t kind, double value) {
    const double bin = std::floor((value - low_) / width_);
    if (bin >= 0 && bin < static_cast<double>(counts_[kind].size()))
      ++counts_[kind][static_cast<std::size_t>(bin)];
  }

  /// Each column reaches to the sum of its kind and those before, per impact.
  void write(std::ostream& out, const std::string& name, double impacts) const {
    out << "$" << name << " << EOD\n";
    for (std::size_t bin = 0; bin < counts_.front().size(); ++bin) {
      out << low_ + (static_cast<double>(bin) + 0.5) * width_;
      double sum = 0;
      for (const auto& kind : counts_) out << ' ' << (sum += kind[bin]) / impacts;
      out << '\n';
    }
    out << "EOD\n";
  }
  double width() const { return width_; }

 private:
  double low_, width_;
  std::vector<std::vector<double>> counts_;
};

struct Kind {
  const char* title;
  const char* colour;
};
constexpr std::array<Kind, 5> kinds = {{{"other grains", "#d9b877"},
                                        {"anti-brink grains", "#8a8f98"},
                                        {"brink grains", "#c2571a"},
                                        {"target grains", "#7a1f5c"},
                                        {"rebound", "#0e6f9e"}}};

std::size_t kind_of(Origin origin) {
  switch (origin) {
    case Origin::anti_brink:
      return 1;
    case Origin::brink:
      return 2;
    case Origin::target:
      return 3;
    case Origin::rebound:
      return 4;
    case Origin::other:
      break;
  }
  return 0;
}

/// The value that a share of all is below, rounded up to a fine number.
double limit_of(std::vector<double> values, double least) {
  if (values.empty()) return least;
  std::sort(values.begin(), values.end());
  const double high =
      std::max(least, values[static_cast<std::size_t>(0.985 * static_cast<double>(values.size() - 1))]);
  const double step = tic_step(high);
  return step * std::ceil(high / step);
}

using Measure = std::function<double(const RisenGrain&)>;

struct Panel {
  std::string label;
  Measure measure;
  bool with_rebound;
  bool both_sides;  ///< of zero
  double least;     ///< the axis goes at least so far
};

}  // namespace

void plot_histograms(const StudyPoint& point, double diameter, const std::string& title,
                     const std::string& path) {
  const std::vector<Panel> panels = {
      {"speed of ejecta [m/s]", [](const RisenGrain& g) { return g.velocity.norm(); }, false, false, 0.1},
      {"vertical speed of all that leave [m/s]", [](const RisenGrain& g) { return g.velocity.z(); }, true,
       false, 0.1},
      {"angle from the vertical [°], forward positive",
       [](const RisenGrain& g) { return std::atan2(g.velocity.x(), g.velocity.z()) / degree; }, false, true,
       90},
      {"origin along the flight [diameters]", [&](const RisenGrain& g) { return g.origin.x() / diameter; },
       false, true, 4}};
  std::ostringstream script;
  script << plot_style << "set multiplot layout 2,2\nset style fill solid 1 noborder\nset grid y\n"
         << "set label 1 " << quoted(title)
         << " at screen 0.06, screen 0.97 left noenhanced font ',17' textcolor rgb measured\n"
         << "set lmargin 9\nset rmargin 3\n";
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = panels[p];
    std::vector<double> sizes;
    for (const ImpactOutcome& o : point.outcomes)
      for (const RisenGrain& g : o.ejecta) sizes.push_back(std::abs(panel.measure(g)));
    if (panel.with_rebound)
      for (const ImpactOutcome& o : point.outcomes)
        if (o.rebound) sizes.push_back(panel.measure(*o.rebound));
    const double high = panel.least == 90 ? 90 : limit_of(sizes, panel.least);
    StackedHistogram histogram(kinds.size(), panel.both_sides ? -high : 0, high, 36);
    for (const ImpactOutcome& o : point.outcomes) {
      for (const RisenGrain& g : o.ejecta) histogram.add(kind_of(g.kind), panel.measure(g));
      if (panel.with_rebound && o.rebound) histogram.add(kind_of(Origin::rebound), panel.measure(*o.rebound));
    }
    const std::string name = fmt::format("panel{}", p);
    histogram.write(script, name, static_cast<double>(std::max<std::size_t>(1, point.outcomes.size())));
    script << panel_place(p % 2 ? 0.57 : 0.08, p % 2 ? 0.97 : 0.48, p < 2 ? 0.85 : 0.41, p < 2 ? 0.56 : 0.11)
           << fmt::format("set xrange [{}:{}]\nset yrange [0:*]\nset xtics {}\nset boxwidth {}\n",
                          panel.both_sides ? -high : 0, high,
                          panel.least == 90 ? 30 : tic_step(high * (panel.both_sides ? 2 : 1)),
                          0.92 * histogram.width())
           << "set xlabel " << quoted(panel.label) << "\nset ylabel 'grains per impact'\n"
           << (p == 1 ? "set key at screen 0.52, screen 0.945 center top horizontal maxrows 1 samplen 1 "
                        "width -2 reverse Left\n"
                      : "unset key\n")
           << "plot ";
    for (std::size_t k = kinds.size(); k-- > 0;) {
      if (k == kind_of(Origin::rebound) && !panel.with_rebound) continue;
      script << fmt::format("${} using 1:{} with boxes lc rgb '{}' title '{}'{}", name, k + 2,
                            kinds[k].colour, kinds[k].title, k > 0 ? ", " : "\n");
    }
    script << "unset label\n";
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 720, path);
}

}  // namespace aeolian
