#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/surface/preview.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_core/twin/report_text.hpp"
#include "aeolian_twin/comparison/compared_surfaces.hpp"
#include "aeolian_twin/comparison/figure_words.hpp"

namespace aeolian {
namespace {

constexpr int plot_width = 820;
constexpr int plot_height = 380;

void draw_heights(const HeightMap& map, ValueRange range, const std::string& path) {
  PreviewOptions options;
  options.range = range;
  write_preview(map, path, options);
}

/// Plain colours, white at zero.
void draw_signed(const GridGeometry& grid, HeightMap::Layer values, const std::string& name,
                 const std::string& path, ValueRange range) {
  HeightMap map(grid);
  PreviewOptions options;
  options.layer = name;
  map.add(options.layer, std::move(values));
  options.palette = Palette::diverging;
  options.range = range;
  options.relief = false;
  write_preview(map, path, options);
}

/// One range for both surfaces; of unlike heights the wider one would show neither.
ValueRange common_range(const ComparedSurfaces& compared) {
  HeightMap::Layer both = compared.a.layer(layer::elevation);
  const HeightMap::Layer& b = compared.b.layer(layer::elevation);
  both.insert(both.end(), b.begin(), b.end());
  return display_range(both, Palette::sand);
}

std::vector<ComparisonPicture> draw_maps(const ComparedSurfaces& compared, const std::string& folder) {
  const GridGeometry& grid = compared.b.geometry();
  const SurfaceComparison& c = compared.comparison;
  const ValueRange heights = common_range(compared);
  draw_heights(compared.a, heights, folder + "/first.png");
  draw_heights(compared.b, heights, folder + "/second.png");
  const HeightMap::Layer& difference = c.map.layer(layer::difference);
  const HeightMap::Layer& levels = c.map.layer(layer::lod95);
  const ValueRange range = display_range(difference, Palette::diverging);
  draw_signed(grid, difference, layer::difference, folder + "/difference.png", range);
  HeightMap::Layer significant = difference;
  for (std::size_t i = 0; i < significant.size(); ++i)
    if (std::abs(significant[i]) <= levels[i]) significant[i] = 0;
  draw_signed(grid, std::move(significant), layer::difference, folder + "/significant.png", range);
  std::vector<ComparisonPicture> pictures{
      {"first.png", "First surface",
       "Heights with light from the north-west, north up." +
           std::string(compared.registered ? " Co-registered with the second." : ""),
       false},
      {"second.png", "Second surface", "The same colours for the same heights. Hatched: not known.", false},
      {"difference.png", "First minus second", "Red: the first is higher. Blue: it is lower.", false},
      {"significant.png", "Where they differ beyond doubt",
       fmt::format(
           "White: within the level of detection (95 %) of the cell. {:.1f} % of the cells exceed it.",
           100 * c.significant_share),
       false}};
  const HeightMap::Layer& displacement = c.map.layer(layer::displacement);
  if (count_known(displacement) == 0) return pictures;
  draw_signed(grid, displacement, layer::displacement, folder + "/displacement.png",
              display_range(displacement, Palette::diverging));
  pictures.push_back(
      {"displacement.png", "How far crests are apart, along the wind",
       "Red: crests of the first lie downwind of the second's, blue: upwind. Each place is a window of "
       "two wavelengths; hatched where none matches.",
       false});
  return pictures;
}

ComparisonPicture draw_profiles(const ComparedSurfaces& compared, const std::string& folder) {
  const GridGeometry& grid = compared.b.geometry();
  const auto curve = [&](const HeightMap::Layer& values, double factor) {
    Curve result;
    for (int x = 0; x < grid.nx(); ++x) {
      result.x.push_back(grid.x(x) * factor);
      result.y.push_back(static_cast<double>(values[grid.index(x, 0)]) * 1000);
    }
    return result;
  };
  const Unit along = length_unit(grid.length_x());
  std::ostringstream script;
  script << plot_style
         << "set multiplot layout 2,1\nset key outside top right horizontal\nset lmargin 9\nset xlabel 'x ["
         << along.name << "]'\n";
  write_data(script, "first", curve(compared.a.layer(layer::elevation), along.factor));
  write_data(script, "second", curve(compared.b.layer(layer::elevation), along.factor));
  write_data(script, "difference", curve(compared.comparison.map.layer(layer::difference), along.factor));
  write_data(script, "level", curve(compared.comparison.map.layer(layer::lod95), along.factor));
  script << "set ylabel 'height [mm]'\nplot $second using 1:2 title 'second' with lines lw 2 lc rgb "
            "measured, $first "
            "using 1:2 title 'first' with lines lw 2 lc rgb forecast\n"
         << "set ylabel 'first - second [mm]'\nplot $level using 1:($2):(-$2) title 'level of detection, 95 "
            "%' with "
            "filledcurves fc rgb '#eadfce', $difference using 1:2 notitle with lines lw 1.5 lc rgb forecast\n"
         << "unset multiplot\n";
  plot_svg(script.str(), 2 * plot_width * 2 / 3, 560, folder + "/profiles.svg");
  return {"profiles.svg", "Both profiles",
          "Above the heights, below how far they differ, with what noise alone would make of it.", true};
}

ComparisonPicture draw_histogram(const ComparedSurfaces& compared, const std::string& folder) {
  const SurfaceComparison& c = compared.comparison;
  constexpr int bins = 81;
  const double reach = std::max(4 * c.difference.nmad.value, 2 * c.difference.le90.value);
  const Unit unit = length_unit(reach > 0 ? reach : 0.001);
  const double half = reach > 0 ? reach * unit.factor : 1;
  const double width = 2 * half / bins;
  std::vector<double> counts(bins);
  for (const float d : c.map.layer(layer::difference)) {
    const double place = (static_cast<double>(d) * unit.factor + half) / width;
    if (place >= 0 && place < bins) counts[static_cast<std::size_t>(place)] += 1;
  }
  Curve bars, normal;
  const double nmad = c.difference.nmad.value * unit.factor;
  for (int i = 0; i < bins; ++i) {
    const double at = -half + (i + 0.5) * width;
    bars.x.push_back(at);
    bars.y.push_back(100 * counts[static_cast<std::size_t>(i)] / static_cast<double>(c.difference.cells));
    normal.x.push_back(at);
    normal.y.push_back(100 * width *
                       std::exp(-0.5 * std::pow((at - c.difference.bias.value * unit.factor) / nmad, 2)) /
                       (nmad * std::sqrt(2 * M_PI)));
  }
  std::ostringstream script;
  write_data(script << plot_style, "bars", bars);
  write_data(script, "normal", normal);
  script << "set key outside top center horizontal\nset xlabel 'first - second [" << unit.name
         << "]'\nset ylabel 'share of cells [%]'\nset yrange [0:*]\n"
         << fmt::format("set xrange [{}:{}]\nset boxwidth {}\nset style fill solid\n", -half, half,
                        0.9 * width)
         << "plot $bars using 1:2 notitle with boxes fc rgb '#e0bd8a'"
         << (nmad > 0 ? ", $normal using 1:2 title 'normal law of the same bias and NMAD' with lines lw 2 lc "
                        "rgb measured\n"
                      : "\n");
  plot_svg(script.str(), plot_width, plot_height, folder + "/histogram.svg");
  return {"histogram.svg", "Distribution of the differences",
          "Bars that reach out beyond the curve are what a normal law would not expect: outliers or change.",
          false};
}

ComparisonPicture draw_coherence(const ComparedSurfaces& compared, const std::string& folder) {
  const Coherence& c = compared.comparison.coherence;
  const Unit unit = length_unit(c.wavelength.front());
  Curve curve, level;
  for (std::size_t i = 0; i < c.wavelength.size(); ++i) {
    curve.x.push_back(c.wavelength[i] * unit.factor);
    curve.y.push_back(c.squared[i]);
    curve.lower.push_back(std::max(0.0, c.squared[i] - c.sigma[i]));
    curve.upper.push_back(std::min(1.0, c.squared[i] + c.sigma[i]));
    level.x.push_back(curve.x.back());
    level.y.push_back(c.level95[i]);
  }
  std::ostringstream script;
  write_data(script << plot_style, "curve", curve);
  write_data(script, "level", level);
  script
      << "set logscale x\nset xlabel 'wavelength along the wind [" << unit.name
      << "]'\nset ylabel 'squared coherence'\nset yrange [0:1.05]\n"
      << fmt::format("set xrange [{}:{}]\n", curve.x.back(), curve.x.front())
      << "set key outside top center horizontal\nplot $level using 1:2 title 'unrelated surfaces stay below, "
         "95 %' with "
         "filledcurves y1=0 fc rgb '#ece6de', $curve using 1:3:4 notitle with filledcurves fc rgb "
         "'#f3c9a9', $curve "
         "using 1:2 title 'coherence' with lines lw 2 lc rgb forecast\n";
  plot_svg(script.str(), plot_width, plot_height, folder + "/coherence.svg");
  return {"coherence.svg", "How alike they are, wavelength by wavelength",
          "1: the same up to a shift. In the grey: no relation can be told. Shaded: one standard error.",
          false};
}

ComparisonPicture draw_scales(const ComparedSurfaces& compared, const std::string& folder) {
  const LineScales& a = compared.comparison.a.scales;
  const LineScales& b = compared.comparison.b.scales;
  const Unit unit = length_unit((b.lag.empty() ? a : b).lag.back());
  const auto curve = [&](const LineScales& scales) {
    return Curve{scales.lag, scales.distribution, {}, {}}.scaled(unit.factor, 1);
  };
  std::ostringstream script;
  script << plot_style << "set xlabel 'lag along the wind [" << unit.name
         << "]'\nset ylabel 'how often heights are alike (mean 1)'\n";
  std::string commands;
  for (const auto& [scales, name, colour] :
       {std::tuple{&b, "second", "measured"}, std::tuple{&a, "first", "forecast"}}) {
    if (scales->lag.empty()) continue;
    write_data(script, name, curve(*scales));
    commands += fmt::format("{} ${} using 1:2 title '{}' with lines lw 2 lc rgb {}",
                            commands.empty() ? "plot" : ",", name, name, colour);
  }
  script << commands << "\n";
  plot_svg(script.str(), plot_width, plot_height, folder + "/scales.svg");
  return {
      "scales.svg", "Which lengths repeat",
      "The distribution of length scales (Werner 1987, eq. 5.2): its first maximum is the dominant length.",
      false};
}

}  // namespace

std::vector<ComparisonPicture> draw_comparison(const ComparedSurfaces& compared, const std::string& folder) {
  std::vector<ComparisonPicture> pictures;
  if (compared.profile)
    pictures.push_back(draw_profiles(compared, folder));
  else
    pictures = draw_maps(compared, folder);
  pictures.push_back(draw_histogram(compared, folder));
  if (!compared.comparison.coherence.wavelength.empty()) pictures.push_back(draw_coherence(compared, folder));
  if (!compared.comparison.a.scales.lag.empty() || !compared.comparison.b.scales.lag.empty())
    pictures.push_back(draw_scales(compared, folder));
  return pictures;
}

}  // namespace aeolian
