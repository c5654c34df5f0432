#include <algorithm>
#include <cmath>
#include <sstream>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_core/twin/report_plots.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {
namespace {

/// A curve with its name in the key and the way gnuplot draws it.
struct Drawn {
  std::string name;
  Curve curve;
  std::string style;
};

/// One of the panels that share the axis of time.
struct Panel {
  std::string title;
  std::string unit;
  std::vector<Drawn> curves;
  std::string nothing;  ///< said when there is no value
};

/// Writes a panel between two heights of the picture (0 bottom, 1 top).
void write_panel(std::ostream& out, const Panel& panel, double top, double bottom) {
  out << "set tmargin at screen " << top << "\nset bmargin at screen " << bottom << "\nset ylabel '"
      << panel.unit << "'\nset label 1 '" << panel.title
      << "' at graph 0.0, graph 1.1 left textcolor rgb measured\n";
  double largest = 0;
  std::string commands;
  for (const Drawn& drawn : panel.curves) {
    if (!drawn.curve.has_value()) continue;
    largest = std::max(largest, drawn.curve.largest());
    const std::string block = "curve" + std::to_string(&drawn - panel.curves.data());
    write_data(out, block, drawn.curve);
    commands += (commands.empty() ? "plot $" : ", $") + block + " using 1:2 title '" + drawn.name +
                "' with " + drawn.style;
  }
  if (commands.empty()) {
    out << "set label 2 '" << panel.nothing << "' at graph 0.5, graph 0.5 center textcolor rgb baseline\n"
        << "set yrange [0:1]\nset format y ''\nplot -1 notitle\nunset label 2\nset format y\n";
    return;
  }
  if (largest == 0) largest = 1;
  out << "set yrange [0:" << 1.15 * largest << "]\nset ytics " << tic_step(largest) << "\n"
      << commands << "\n";
}

/// One number of some states over time.
Curve curve_of(const std::vector<Run::State>& states, double Run::State::*number) {
  Curve curve;
  for (const Run::State& state : states) {
    curve.x.push_back(state.time);
    curve.y.push_back(state.*number);
  }
  return curve;
}

}  // namespace

void plot_growth(const Run& run, const std::vector<LeadSummary>& leads, const std::string& path) {
  double end = 0;
  for (const Run::State& state : run.states) end = std::max(end, state.time);
  for (const Run::Score& score : run.scores) end = std::max(end, score.time);
  const Unit time = time_unit(end);
  const std::string points = run.states.size() > 60 ? "0.25" : "0.5";
  const std::string measured_style = "linespoints lw 1.2 pt 7 ps " + points + " lc rgb measured";

  const auto ripple_panel = [&](const std::string& title, double Run::State::*number,
                                double Comparison::*predicted) {
    const Curve measured = curve_of(run.states, number);
    Curve forecast;
    if (!leads.empty())
      for (const Run::Score& score : leads.back().scores) {
        forecast.x.push_back(score.time);
        forecast.y.push_back(score.comparison.*predicted);
      }
    const Unit unit = length_unit(measured.largest());
    const auto in_units = [&](const Curve& curve) { return curve.scaled(time.factor, unit.factor); };
    return Panel{title,
                 unit.name,
                 {{"true", in_units(curve_of(run.true_states, number)), "lines lw 6 lc rgb truth"},
                  {"measured", in_units(measured), measured_style},
                  {"forecast", in_units(forecast), "points pt 6 ps 0.8 lw 1.6 lc rgb forecast"}},
                 "no ripples were found"};
  };
  std::ostringstream script;
  script << plot_style
         << "set multiplot\nset lmargin at screen 0.09\nset rmargin at screen 0.97\nset xrange [0:"
         << (end > 0 ? end * time.factor : 1)
         << "]\nset key at graph 1.0, graph 1.2 right horizontal samplen 2\nset format x ''\n";
  write_panel(script,
              ripple_panel("Ripple wavelength", &Run::State::wavelength, &Comparison::wavelength_predicted),
              0.94, 0.70);
  write_panel(
      script,
      ripple_panel("Ripple height, trough to crest", &Run::State::height, &Comparison::height_predicted),
      0.62, 0.38);
  const Curve wind = curve_of(run.states, &Run::State::friction_velocity).scaled(time.factor, 1);
  script << "set format x '%g'\nset xlabel 'time since the start of the run [" << time.name
         << "]'\nunset key\n";
  write_panel(script,
              {"Friction velocity of the wind", "m/s", {{"", wind, measured_style}}, "the wind is not known"},
              0.30, 0.11);
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 640, path);
}

}  // namespace aeolian
