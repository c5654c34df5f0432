#include "aeolian_twin/photo/profile_plot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/photo/figure_units.hpp"
#include "aeolian_twin/photo/plot_panel.hpp"

namespace aeolian {
namespace {

constexpr int width_px = 1100;
constexpr int height_px = 640;
constexpr double left = 0.075;
constexpr double right = 0.975;

/// The measured line with its 95 % interval.
Curve profile_curve(const EvenProfile& even) {
  constexpr double normal_95 = 1.96;
  Curve curve;
  for (std::size_t i = 0; i < even.z.size(); ++i) {
    curve.x.push_back(even.start + even.step * static_cast<double>(i));
    curve.y.push_back(even.z[i]);
    curve.lower.push_back(even.z[i] - normal_95 * even.sigma_z[i]);
    curve.upper.push_back(even.z[i] + normal_95 * even.sigma_z[i]);
  }
  return curve.scaled(to_mm, to_mm);
}

/// Slopes over the stretch that the analysis takes for the steepest: a tenth of a ripple [degrees].
Curve slope_curve(const ProfileAnalysis& analysis) {
  const EvenProfile& even = analysis.even;
  const double stretch = analysis.ripples.empty() ? 4 * even.step : analysis.wavelength.value / 10;
  const auto half = static_cast<std::size_t>(std::max(1.0, std::round(stretch / even.step / 2)));
  Curve curve;
  for (std::size_t i = half; i + half < even.z.size(); ++i) {
    curve.x.push_back(to_mm * (even.start + even.step * static_cast<double>(i)));
    curve.y.push_back(to_degrees * std::atan2(even.z[i + half] - even.z[i - half],
                                              2 * static_cast<double>(half) * even.step));
  }
  return curve;
}

/// The stations as they were found, before smoothing.
Curve station_curve(const ShadowProfile& profile) {
  return Curve{horizontal_places(profile), profile.z, {}, {}}.scaled(to_mm, to_mm);
}

void write_ripples(std::ostream& out, const ProfileAnalysis& analysis) {
  Curve crests;
  out << "$tangents << EOD\n";
  for (const ProfileRipple& ripple : analysis.ripples) {
    for (const double place : {ripple.start, ripple.end})
      out << to_mm * place << ' ' << to_mm * height_at(analysis.even, place) << '\n';
    out << '\n';
    crests.x.push_back(to_mm * ripple.crest);
    crests.y.push_back(to_mm * height_at(analysis.even, ripple.crest));
  }
  out << "EOD\n";
  write_data(out, "crests", crests);
}

}  // namespace

void plot_profile(const MeasuredPhoto& photo, const std::string& path) {
  const ProfileAnalysis& analysis = photo.analysis;
  const Curve profile = profile_curve(analysis.even);
  const Curve stations = station_curve(photo.profile);
  const Curve slopes = slope_curve(analysis);
  const PlotRange x = range_of(profile.x, 0.01);
  std::vector<double> heights = stations.y;
  heights.insert(heights.end(), profile.lower.begin(), profile.lower.end());
  heights.insert(heights.end(), profile.upper.begin(), profile.upper.end());
  const PlotRange z = range_of(heights, 0.08);
  constexpr double top = 0.86;
  constexpr double bottom = 0.44;
  const double exaggeration =
      (top - bottom) * height_px / z.width() / ((right - left) * width_px / x.width());

  std::ostringstream script;
  script << plot_style;
  write_data(script, "profile", profile);
  write_data(script, "stations", stations);
  write_data(script, "slopes", slopes);
  write_ripples(script, analysis);
  script << "set multiplot\n"
         << "set label 1 " << quoted(photo.name) << " at screen " << left
         << ", screen 0.965 left noenhanced font ',17' textcolor rgb measured\n"
         << "set label 2 " << quoted(in_one_line(analysis, "±")) << " at screen " << left
         << ", screen 0.918 left noenhanced textcolor rgb '#6b6058'\n"
         << "set label 3 " << quoted(fmt::format("heights {:.2g} times exaggerated", exaggeration))
         << " at graph 0.995, graph 0.05 right textcolor rgb baseline\n"
         << fmt::format("set xrange [{}:{}]\n", x.low, x.high) << panel_place(left, right, top, bottom)
         << fmt::format("set yrange [{}:{}]\nset ytics {}\n", z.low, z.high, tic_step(z.width()))
         << "set format x ''\nset ylabel 'height [mm]' offset 0.5\n"
         << "set key at screen " << right << ", screen 0.968 right top horizontal samplen 2\n"
         << "plot $profile using 1:3:4 with filledcurves fc rgb '#f0cfa8' title '95 %', \\\n"
         << "  $stations using 1:2 with points pt 7 ps 0.28 lc rgb '#c08a50' title 'as found', \\\n"
         << "  $profile using 1:2 with lines lw 1.8 lc rgb measured title 'smoothed'";
  if (!analysis.ripples.empty())
    script
        << ", \\\n  $tangents using 1:2 with linespoints lw 1.4 pt 7 ps 0.35 lc rgb second title 'tangents', "
           "\\\n  $crests using 1:2 with points pt 9 ps 0.8 lc rgb forecast title 'crests'";
  const PlotRange slope = range_of(slopes.y, 0.08);
  script << "\nunset label\nunset key\n"
         << panel_place(left, right, 0.39, 0.11)
         << fmt::format("set yrange [{}:{}]\nset ytics {}\n", slope.low, slope.high, tic_step(slope.width()))
         << "set format x '%g'\nset xlabel 'along the straightedge, horizontal [mm]"
         << (analysis.downwind_known
                 ? (analysis.downwind > 0 ? "; the wind blows to the right" : "; the wind blows to the left")
                 : "")
         << "'\nset ylabel 'slope [°]' offset 0.5\nset xzeroaxis lc rgb '#8a7f76'\n"
         << "plot $slopes using 1:2 with lines lw 1.4 lc rgb second notitle\nunset multiplot\n";
  plot_svg(script.str(), width_px, height_px, path);
}

}  // namespace aeolian
