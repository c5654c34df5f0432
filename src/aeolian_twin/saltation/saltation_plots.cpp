#include "aeolian_twin/saltation/saltation_plots.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"

namespace aeolian {
namespace {

const char* const colours[] = {"#8a8f98", "#3c6e9f", "#e0a03a", "#c2571a", "#2e2723"};
constexpr std::size_t most_points = 400;

std::string name_of(const SteadyState& s) { return fmt::format("u_* = {:.2f} m/s", s.friction_velocity); }

std::string colour_of(std::size_t wind, std::size_t winds) {
  return colours[std::size(colours) - std::min(winds, std::size(colours)) + wind % std::size(colours)];
}

/// Means over layers that grow with height as the spacing of the grains' summits does; y are their middles
/// [cm].
Curve against_height(const SaltationProfiles& p, const std::vector<double>& column, double unit) {
  constexpr double growth = 1.4;
  Curve curve;
  std::size_t begin = 0;
  for (double border = 0.001; begin < column.size(); border *= growth) {
    const auto end = std::min(column.size(), static_cast<std::size_t>(std::ceil(border / p.thickness)));
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += column[i];
    curve.x.push_back(sum / static_cast<double>(end - begin) * unit);
    curve.y.push_back(100 * 0.5 * (p.height[begin] + p.height[end - 1]));
    begin = end;
  }
  return curve;
}

/// Height below which nearly all of the flux passes [m].
double layer_height(const SaltationProfiles& p) {
  double all = 0;
  for (const double q : p.number_flux) all += q;
  double below = 0;
  for (std::size_t i = 0; i < p.height.size(); ++i)
    if ((below += p.number_flux[i]) > 0.98 * all) return p.height[i];
  return p.height.empty() ? 0.01 : p.height.back();
}

/// Height of crossing of the first and the last wind [m], zero where they do not cross above 0.1 mm.
double focus(const SteadyState& weak, const SteadyState& strong) {
  for (std::size_t i = 1; i < WindProfile::levels; ++i) {
    const double a = strong.wind.speed_at_level(i - 1) - weak.wind.speed_at_level(i - 1);
    const double b = strong.wind.speed_at_level(i) - weak.wind.speed_at_level(i);
    if (a < 0 && b >= 0 && weak.wind.height(i) > 1e-4) {
      const double part = a / (a - b);
      return weak.wind.height(i - 1) * std::pow(weak.wind.height(i) / weak.wind.height(i - 1), part);
    }
  }
  return 0;
}

std::vector<const SolvedWind*> blowing(const SaltationRun& run) {
  std::vector<const SolvedWind*> result;
  for (const SolvedWind& wind : run.winds)
    if (wind.state.steady()) result.push_back(&wind);
  return result;
}

void plot_winds(const std::vector<const SolvedWind*>& winds, const std::string& path) {
  std::ostringstream script;
  std::string curves;
  for (std::size_t i = 0; i < winds.size(); ++i) {
    const SteadyState& s = winds[i]->state;
    Curve with, without;
    for (std::size_t k = 0; k < WindProfile::levels && s.wind.height(k) < 1; ++k) {
      with.x.push_back(s.wind.speed_at_level(k));
      without.x.push_back(s.friction_velocity / 0.4 * std::log(s.wind.height(k) / s.wind.roughness()));
      with.y.push_back(100 * s.wind.height(k));
      without.y.push_back(100 * s.wind.height(k));
    }
    write_data(script, fmt::format("with{}", i), with);
    write_data(script, fmt::format("without{}", i), without);
    const std::string colour = colour_of(i, winds.size());
    curves += fmt::format("{}$with{} with lines lw 2.5 lc rgb '{}' title '{}'", i ? ", " : "", i, colour,
                          name_of(s));
    curves += fmt::format(", $without{} with lines lw 1 dt 3 lc rgb '{}' title '{}'", i, colour,
                          i + 1 == winds.size() ? "without grains" : "");
  }
  std::string mark;
  if (winds.size() > 1) {
    const double height = focus(winds.front()->state, winds.back()->state);
    if (height > 0) {
      const double speed = winds.back()->state.wind.speed(height);
      mark = fmt::format(
          "set label 1 'winds cross near {:.2g} cm' at {},{} right offset -1.2,0.3 textcolor rgb '#4a413b'\n"
          "set label 2 '' at {},{} point pt 6 ps 1.8 lw 2 lc rgb '#4a413b'\n",
          100 * height, speed, 100 * height, speed, 100 * height);
    }
  }
  const SteadyState& strongest = winds.back()->state;
  script << plot_style
         << "set logscale y\nset yrange [0.001:100]\nset xrange [0:" << 1.15 * strongest.wind.speed(1)
         << "]\nset grid x y\n"
         << "set xlabel 'mean wind [m/s]'\nset ylabel 'height over the bed [cm]'\nset key top left\n"
         << "set title 'Wind in balance with saltating grains'\n"
         << mark << "plot " << curves << "\n";
  plot_svg(script.str(), 760, 620, path);
}

void plot_heights(const std::vector<const SolvedWind*>& winds, const std::string& path) {
  std::ostringstream script;
  double top = 0;
  for (const SolvedWind* wind : winds) top = std::max(top, layer_height(wind->profiles));
  const struct {
    const char* name;
    const char* title;
    std::vector<double> SaltationProfiles::*column;
    double unit;
  } panels[] = {
      {"flux", "mass flux [kg m^{-2} s^{-1}]", &SaltationProfiles::number_flux, winds[0]->state.grain_mass},
      {"energy", "kinetic-energy flux [W m^{-2}]", &SaltationProfiles::kinetic_flux, 1},
      {"drag", "drag of the grains on the air [N m^{-3}]", &SaltationProfiles::drag, 1}};
  for (std::size_t i = 0; i < winds.size(); ++i)
    for (const auto& panel : panels)
      write_data(script, fmt::format("{}{}", panel.name, i),
                 against_height(winds[i]->profiles, winds[i]->profiles.*panel.column, panel.unit));
  script << plot_style
         << "set grid x y\nset multiplot layout 1,3 title 'What flies at which height'\nset yrange [0:"
         << 100 * top << "]\nset xtics rotate by -35\n";
  for (const auto& panel : panels) {
    const bool first = &panel == &panels[0];
    script << "set xlabel '" << panel.title << "' offset 0,-0.6\nset xrange ["
           << (panel.name[0] == 'd' ? "*" : "0") << ":*]\nset ylabel '"
           << (first ? "height over the bed [cm]" : "") << "'\n"
           << (panel.name[0] == 'd' ? "set key top right\n" : "unset key\n") << "plot ";
    for (std::size_t i = 0; i < winds.size(); ++i)
      script << (i ? ", " : "") << "$" << panel.name << i << " with lines lw 2.2 lc rgb '"
             << colour_of(i, winds.size()) << "' title '" << name_of(winds[i]->state) << "'";
    script << "\n";
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 1080, 480, path);
}

/// The share of grains that are not faster than each speed, in per cent.
Curve slower(const std::vector<double>& speed, const std::vector<double>& number) {
  std::vector<std::pair<double, double>> grains;
  double all = 0;
  for (std::size_t k = 0; k < speed.size(); ++k) {
    if (!(number[k] > 0)) continue;
    grains.emplace_back(speed[k], number[k]);
    all += number[k];
  }
  std::sort(grains.begin(), grains.end());
  Curve curve;
  double below = 0;
  for (const auto& [v, n] : grains) {
    curve.x.push_back(v);
    curve.y.push_back(100 * (below + 0.5 * n) / all);
    below += n;
  }
  return curve;
}

void plot_launches(const std::vector<const SolvedWind*>& winds, const std::string& path) {
  std::ostringstream script;
  double up = 0, impact = 0;
  for (const SolvedWind* wind : winds) {
    const SteadyState& s = wind->state;
    up = std::max(up, s.mean(s.launches.vy) + 3.5 * s.spread(s.launches.vy));
    impact = std::max(impact, s.mean(s.landings.vx) + 3.5 * s.spread(s.landings.vx));
  }
  // A single launch speed has no spread.
  up = std::max(up, 0.2);
  for (std::size_t i = 0; i < winds.size(); ++i) {
    const SteadyState& s = winds[i]->state;
    std::vector<double> total(s.landings.vx.size());
    for (std::size_t k = 0; k < total.size(); ++k) total[k] = std::hypot(s.landings.vx[k], s.landings.vy[k]);
    write_data(script, fmt::format("up{}", i), slower(s.launches.vy, s.launches.number));
    write_data(script, fmt::format("impact{}", i), slower(total, s.launches.number));
  }
  script << plot_style
         << "set grid x y\nset multiplot layout 1,2 title 'Grains that leave the bed and grains that land'\n"
         << "set ylabel 'grains that are slower [%]'\nset yrange [0:100]\nset key bottom right\n";
  for (const char* name : {"up", "impact"}) {
    const bool leaving = name[0] == 'u';
    script << "set xlabel '" << (leaving ? "upward speed at launch [m/s]" : "speed of impact [m/s]")
           << "'\nset xrange [0:" << (leaving ? up : impact) << "]\nplot ";
    for (std::size_t i = 0; i < winds.size(); ++i)
      script << (i ? ", " : "") << "$" << name << i << " with lines lw 2.2 lc rgb '"
             << colour_of(i, winds.size()) << "' title '" << name_of(winds[i]->state) << "'";
    script << "\n";
  }
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, 440, path);
}

/// Not more points than a picture can show.
Curve thinned(const std::vector<double>& x, const std::vector<double>& y, double unit) {
  const std::size_t step = std::max<std::size_t>(1, x.size() / (5 * most_points));
  Curve curve;
  for (std::size_t i = 0; i < x.size(); i += step) {
    curve.x.push_back(x[i]);
    curve.y.push_back(unit * y[i]);
  }
  return curve;
}

}  // namespace

void plot_saltation(const SaltationRun& run, const std::string& folder) {
  const std::vector<const SolvedWind*> winds = blowing(run);
  if (winds.empty()) return;
  plot_winds(winds, folder + "/winds.svg");
  plot_heights(winds, folder + "/heights.svg");
  plot_launches(winds, folder + "/launches.svg");
}

void plot_gusts(const GustRun& g, const std::string& folder) {
  std::ostringstream script;
  write_data(script, "wind", thinned(g.time, g.friction_velocity, 1));
  write_data(script, "steady", thinned(g.time, g.steady, 1000));
  write_data(script, "relaxed", thinned(g.time, g.relaxed, 1000));
  if (!g.in_time.empty()) write_data(script, "solved", thinned(g.time, g.in_time, 1000));
  script << plot_style << "set multiplot layout 2,1\nset xrange [" << g.time.front() << ":" << g.time.back()
         << "]\nset yrange [0:*]\nset lmargin 9\nset ylabel 'friction velocity [m/s]'\nunset key\n"
         << "plot $wind with lines lw 1.5 lc rgb measured\n"
         << "set key outside top center horizontal\nset xlabel 'time [s]'\nset ylabel 'mass flux [g m^{-1} "
            "s^{-1}]'\n"
         << "plot $steady with lines lw 1 lc rgb baseline title 'in balance with each moment', "
         << "$relaxed with lines lw 2 lc rgb forecast title 'relaxing, with hysteresis'";
  if (!g.in_time.empty())
    script << ", $solved with lines lw 2 lc rgb second title 'solved in time (eq. 4.35)'";
  script << "\nunset multiplot\n";
  plot_svg(script.str(), 1000, 560, folder + "/gusts.svg");
}

}  // namespace aeolian
