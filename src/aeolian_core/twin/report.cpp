#include "aeolian_core/twin/report.hpp"

#include <algorithm>
#include <filesystem>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/preview.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/twin/on_grid.hpp"
#include "aeolian_core/twin/report_page.hpp"
#include "aeolian_core/twin/report_plots.hpp"
#include "aeolian_core/twin/report_tables.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {
namespace {

class Directory {
 public:
  explicit Directory(const std::string& path) : path_(path) { make_directory(path); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Draws heights with hill shading.
void draw_heights(const GridGeometry& geometry, const HeightMap::Layer& values, ValueRange range,
                  const std::string& path) {
  HeightMap map(geometry);
  map.add(layer::elevation, values);
  PreviewOptions options;
  options.range = range;
  write_preview(map, path, options);
}

/// Draws differences of heights in plain colours, white at zero.
void draw_differences(const GridGeometry& geometry, const HeightMap::Layer& values, ValueRange range,
                      const std::string& path) {
  HeightMap map(geometry);
  PreviewOptions options;
  options.layer = "difference";
  map.add(options.layer, values);
  options.palette = Palette::diverging;
  options.range = range;
  options.relief = false;
  write_preview(map, path, options);
}

/// Measured map and forecast in one range of colours; their difference and the change to be forecast in
/// another.
std::vector<Picture> draw_maps(const Run& run, const Directory& directory) {
  const GridGeometry& grid = run.measured.geometry();
  const HeightMap::Layer& measured = run.measured.layer(layer::elevation);
  const ValueRange heights = display_range(measured, Palette::sand);
  draw_heights(grid, measured, heights, directory.file("measured.png"));
  std::vector<Picture> figures{
      {"measured.png", "Measured surface",
       "The map made of the sensor's scans. How to read it: pale is high, dark is low; ripples "
       "show as bands across the wind."}};
  if (!run.forecast.has(layer::elevation)) return figures;

  const HeightMap forecast_map = on_grid(run.forecast, grid);
  const HeightMap::Layer& forecast = forecast_map.layer(layer::elevation);
  draw_heights(grid, forecast, heights, directory.file("forecast.png"));
  figures.push_back(
      {"forecast.png", "Forecast for the same moment",
       "Made " + duration_text(run.forecast_lead) +
           " earlier, without sight of the map on the left. Same colours: where the pictures agree, the "
           "forecast was right."});
  const HeightMap::Layer errors = difference(forecast, measured);
  ValueRange range = display_range(errors, Palette::diverging);
  if (forecast_map.has(layer::initial)) {
    const HeightMap::Layer change = difference(measured, forecast_map.layer(layer::initial));
    const ValueRange of_change = display_range(change, Palette::diverging);
    range = {std::min(range.low, of_change.low), std::max(range.high, of_change.high)};
    draw_differences(grid, change, range, directory.file("change.png"));
    figures.push_back(
        {"change.png", "What changed: measured, now minus start of the forecast",
         "Red has risen, blue has sunk. This is what the forecast had to foresee, and the error of saying "
         "“nothing changes” turned upside down."});
  }
  draw_differences(grid, errors, range, directory.file("difference.png"));
  figures.push_back(
      {"difference.png", "What the forecast missed: forecast minus measured",
       "Red: forecast too high, blue: too low, white: right. Same colours as the change; the paler this "
       "picture beside that one, the better the forecast."});
  return figures;
}

/// How far measured map and forecast are from the truth, with a picture of the former.
TruthStatistics compare_with_truth(const Run& run, const Directory& directory) {
  const GridGeometry& grid = run.measured.geometry();
  const HeightMap truth_map = on_grid(*run.truth, grid);
  const HeightMap::Layer& truth = truth_map.layer(layer::elevation);
  const HeightMap::Layer& measured = run.measured.layer(layer::elevation);
  TruthStatistics result{difference_statistics(measured, truth), std::nullopt, {}};
  if (result.measured.cells == 0) throw Error("report: the truth shares no known cell with the measured map");
  if (run.forecast.has(layer::elevation))
    result.forecast = difference_statistics(on_grid(run.forecast, grid).layer(layer::elevation), truth);
  const HeightMap::Layer errors = difference(measured, truth);
  draw_differences(grid, errors, display_range(errors, Palette::diverging), directory.file("map_error.png"));
  result.picture = {"map_error.png", "What the sensor missed: measured minus true surface",
                    "Fine grain is noise. Bands along the ripples mean that the map lags behind the moving "
                    "sand or flattens it. Mind that the colours have a range of their own."};
  return result;
}

}  // namespace

void write_report(const Run& run, const std::string& path) {
  if (!run.measured.has(layer::elevation) || count_known(run.measured.layer(layer::elevation)) == 0)
    throw Error("report: there is no measured map");
  const Directory directory(path);
  PageContents page{run, summarise_by_lead(run.scores), draw_maps(run, directory), {}, {}, {}, {}};
  if (run.truth) page.truth = compare_with_truth(run, directory);
  if (!run.states.empty()) {
    plot_growth(run, page.leads, directory.file("growth.svg"));
    page.growth = {
        "growth.svg", "Ripples and wind over time",
        "How to read it: each black dot is a measured map, each open circle a forecast of the longest lead "
        "time, drawn at the time for which it was made. Circles on dots mean a good forecast. Ripples grow "
        "while the wind's friction velocity is above the impact threshold, and rest below it." +
            std::string(run.true_states.empty() ? "" : " The broad pale line is the true surface.")};
    write_csv(ripple_table(run), directory.file("ripples.csv"));
    page.tables.emplace_back("ripples.csv");
  }
  if (!page.leads.empty()) {
    plot_skill(page.leads, directory.file("skill.svg"));
    page.skill = {
        "skill.svg", "Error and skill by lead time",
        "How to read it: points are medians over all forecasts of a lead time, bars reach from the lower to "
        "the "
        "upper quartile. On the left, lower is better: the forecast should lie below the grey line. On the "
        "right, higher is better: 1 is a perfect forecast, above the black line at 0 it beats the baseline."};
    write_csv(lead_table(page.leads), directory.file("lead_times.csv"));
    write_csv(score_table(run), directory.file("scores.csv"));
    page.tables.insert(page.tables.begin(), {"lead_times.csv", "scores.csv"});
  }
  write_text_atomically(directory.file("index.html"), report_page(page));
}

}  // namespace aeolian
