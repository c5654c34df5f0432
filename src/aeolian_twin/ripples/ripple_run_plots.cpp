#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/ripples/ripple_run_files.hpp"

namespace aeolian {
namespace {

constexpr int section_px = 60;
constexpr double section_width_px = 1050;

std::string time_text(double seconds) {
  return seconds < 120 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.3g} min", seconds / 60);
}

/// At most `count` of the sections, evenly chosen, with the first and the last.
std::vector<const WindSection*> some_of(const std::vector<WindSection>& sections, std::size_t count) {
  std::vector<const WindSection*> chosen;
  const std::size_t all = sections.size();
  const std::size_t used = std::min(all, count);
  for (std::size_t i = 0; i < used; ++i)
    chosen.push_back(&sections[used == 1 ? 0 : (i * (all - 1) + (used - 1) / 2) / (used - 1)]);
  return chosen;
}

}  // namespace

void plot_ripple_history(const RippleRun& run, const std::string& folder) {
  Curve wavelength, height, speed;
  for (const RippleMoment& m : run.moments) {
    for (Curve* curve : {&wavelength, &height, &speed}) curve->x.push_back(m.time / 60);
    wavelength.y.push_back(100 * m.ripples.wavelength);
    height.y.push_back(1000 * m.ripples.height);
    speed.y.push_back(6000 * m.speed);
  }
  struct Panel {
    const char* name;
    const Curve& curve;
    const char* label;
  };
  const Panel panels[] = {{"wavelength", wavelength, "wavelength [cm]"},
                          {"height", height, "height [mm]"},
                          {"speed", speed, "speed [cm/min]"}};
  std::ostringstream script;
  script << plot_style << "set multiplot layout 3,1\nunset key\nset lmargin 10\n"
         << fmt::format("set xrange [0:{:g}]\nset yrange [0:*]\n", run.moments.back().time / 60);
  for (const Panel& panel : panels) {
    write_data(script, panel.name, panel.curve);
    script << "set ylabel '" << panel.label << "'\n"
           << (&panel == &panels[2] ? "set xlabel 'time [min]'\n" : "unset xlabel\n");
    if (panel.curve.has_value())
      script << "plot $" << panel.name << " using 1:2 with linespoints pt 7 ps 0.3 lw 1.5 lc rgb forecast\n";
    else
      script << "set label 1 'no ripples' at graph 0.5, graph 0.5 center\nset yrange [0:1]\nplot 2\nunset "
                "label 1\nset yrange [0:*]\n";
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 900, 700, folder + "/ripples.svg");
}

void plot_sections(const std::vector<WindSection>& sections, const std::string& folder) {
  const std::vector<const WindSection*> shown = some_of(sections, 12);
  double least = 1e300;
  double largest = -1e300;
  for (const WindSection* section : shown)
    for (const double h : section->height) {
      if (!std::isfinite(h)) continue;
      least = std::min(least, h);
      largest = std::max(largest, h);
    }
  const double apart = std::max(largest - least, 1e-6) * 1000;
  std::ostringstream script;
  script << plot_style << "unset key\nunset ytics\nunset grid\nset border 1\nset lmargin 12\n"
         << "set xlabel 'along the wind [cm]; wind to the right'\n";
  std::string plots;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    Curve curve{shown[i]->along, shown[i]->height, {}, {}};
    const double base = -static_cast<double>(i) * apart;
    curve = curve.scaled(100, 1000);
    for (double& h : curve.y) h += base - 1000 * least;
    const std::string name = fmt::format("section{}", i);
    write_data(script, name, curve);
    script << fmt::format("set label {} '{}' at graph -0.01, first {} right textcolor rgb measured\n", i + 1,
                          time_text(shown[i]->time), base + 0.5 * apart);
    plots += fmt::format(
        "{}${} using 1:2 with filledcurves y={} fc rgb truth, ${} using 1:2 with lines lw 1.2 lc rgb "
        "measured",
        i > 0 ? ", " : "", name, base, name);
  }
  // Pixels per metre along and up, with the margins that gnuplot leaves.
  const double length = shown.front()->along.back();
  const double exaggeration = section_px / (apart / 1000) / (section_width_px / length);
  script
      << fmt::format(
             "set title 'the bed along the wind, heights {:.2g} times exaggerated' textcolor rgb measured\n",
             exaggeration)
      << fmt::format("set xrange [0:{}]\nset yrange [{}:{}]\nplot {}\n", 100 * length,
                     -static_cast<double>(shown.size() - 1) * apart - 0.05 * apart, 1.1 * apart, plots);
  plot_svg(script.str(), 1200, 140 + section_px * static_cast<int>(shown.size()), folder + "/sections.svg");
}

}  // namespace aeolian
