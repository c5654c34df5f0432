#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/photo/figure_units.hpp"
#include "aeolian_twin/photo/plot_panel.hpp"
#include "aeolian_twin/photo/series.hpp"

namespace aeolian {
namespace {

constexpr double panel_left = 0.12;
constexpr double panel_right = 0.965;

/// A profile without its slope.
Curve level_curve(const EvenProfile& even) {
  Curve curve;
  curve.y = detrended(even);
  for (std::size_t i = 0; i < curve.y.size(); ++i)
    curve.x.push_back(even.start + even.step * static_cast<double>(i));
  return curve.scaled(to_mm, to_mm);
}

/// The label of a line of the waterfall: the time since the first photo, or the photo's name.
std::string label_of(const MeasuredSeries& series, std::size_t photo) {
  if (!series.photos.front().time || !series.photos.back().time) return series.photos[photo].name;
  const double start = *series.photos.front().time;
  const double seconds = *series.photos[photo].time - start;
  constexpr double long_series = 300;
  return *series.photos.back().time - start < long_series ? fmt::format("{:.0f} s", seconds)
                                                          : fmt::format("{:.1f} min", seconds / 60);
}

void write_waterfall(std::ostream& out, const MeasuredSeries& series, double bottom) {
  std::vector<Curve> curves;
  std::vector<double> relief;
  std::vector<double> places;
  for (const MeasuredPhoto& photo : series.photos) {
    curves.push_back(level_curve(photo.analysis.even));
    relief.push_back(range_of(curves.back().y, 0).width());
    places.insert(places.end(), {curves.back().x.front(), curves.back().x.back()});
  }
  const double distance = 1.15 * *std::max_element(relief.begin(), relief.end());
  const PlotRange x = range_of(places, 0.01);
  const auto count = static_cast<double>(curves.size());
  std::string tics;
  std::string plot;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double offset = distance * static_cast<double>(i);
    for (double& y : curves[i].y) y += offset;
    write_data(out, fmt::format("profile{}", i), curves[i]);
    // No more labels than have room.
    if (i % (1 + curves.size() / 25) == 0)
      tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", quoted(label_of(series, i)), offset);
    plot += fmt::format("{}$profile{} using 1:2 with lines lw 1.3 lc rgb measured notitle",
                        plot.empty() ? "plot " : ", ", i);
  }
  out << panel_place(panel_left, panel_right, 0.92, bottom)
      << fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", x.low, x.high, -0.8 * distance,
                     (count - 0.2) * distance)
      << "set ytics noenhanced (" << tics
      << ")\nset xlabel 'along the straightedge, horizontal [mm]'\nunset grid\n"
      << "set label 1 'Profiles in order of time, the first at the bottom' at graph 0, graph 1.03 left "
         "textcolor rgb measured\n"
      << "set label 2 " << quoted(fmt::format("from line to line {:.3g} mm", distance))
      << " at graph 1, graph 1.03 right textcolor rgb baseline\n"
      << plot << "\nunset label\n";
}

void write_migration(std::ostream& out, const ProfileSeries& change, const std::string& direction) {
  Curve speed;
  std::vector<double> ends;
  for (const ProfileSeries::Step& step : change.steps) {
    const double value = to_mm_per_minute * step.migration.value;
    const double half = 1.96 * to_mm_per_minute * step.migration.sigma;
    speed.x.push_back(step.time / 60);
    speed.y.push_back(value);
    speed.lower.push_back(value - half);
    speed.upper.push_back(value + half);
    ends.insert(ends.end(), {value - half, value + half, 0.0});
  }
  write_data(out, "speed", speed);
  const PlotRange y = range_of(ends, 0.1);
  const PlotRange x = range_of(speed.x, 0.05);
  out << panel_place(panel_left, panel_right, 0.27, 0.08)
      << fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset ytics {}\n", std::min(0.0, x.low), x.high,
                     y.low, y.high, tic_step(y.width()))
      << "set xlabel 'time since the first photo [min]'\nset ylabel 'mm/min'\nset grid y\n"
      << "set label 1 'Migration " << direction
      << ", 95 %' at graph 0, graph 1.12 left textcolor rgb measured\n"
      << "plot $speed using 1:2:3:4 with yerrorbars pt 7 ps 0.5 lw 1.3 lc rgb forecast notitle\n";
}

}  // namespace

void plot_series(const MeasuredSeries& series, const std::string& path) {
  const bool rates = series.change && !series.change->steps.empty();
  std::ostringstream script;
  script << plot_style << "set multiplot\n";
  write_waterfall(script, series, rates ? 0.38 : 0.08);
  if (rates) write_migration(script, *series.change, migration_direction(series));
  script << "unset multiplot\n";
  plot_svg(script.str(), 1000, rates ? 900 : 700, path);
}

}  // namespace aeolian
