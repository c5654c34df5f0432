// track_ripples: crests of ripples on height maps in time: their size, shape, ends, motion and what becomes
// of them.

#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/tools/crest_picture.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/ripple_tables.hpp"
#include "aeolian_twin/tools/track_picture.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Follows ripples over height maps of one grid (GeoTIFF with the band elevation), in the order of time.

    track_ripples --out DIR map_000.tif map_060.tif ... [--times S,S,...] [--direction-deg D | --from-deg D]

Times are seconds: --times, or the column t_s of --times-csv, or the last number in each file's name. One map alone has no
motion. Without a direction of the wind it is taken from the ripples on the last map: square to the crests, the way they
go, or where there is one map the way their steeper flanks face.

Written to DIR: ripples.csv (what each map says), crests.csv and crest_lines.csv (each crest), events.csv (mergers, splits,
repulsions, births, losses, ends of crests that move along), tracks.svg (crests in time along the wind) and for each map a
picture NAME_crests.png.)";

struct Options {
  std::vector<std::string> maps;
  std::string out;
  std::vector<double> times;
  std::string times_csv;
  std::optional<double> direction_deg;
  std::optional<double> from_deg;
  double grain_mm = 0;
};

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

/// The last number in a file's name.
double time_in_name(const std::string& path) {
  const std::string name = stem(path);
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t end = name.size();
  while (end > 0 && !is_digit(name[end - 1])) --end;
  std::size_t start = end;
  while (start > 0 && (is_digit(name[start - 1]) || name[start - 1] == '.')) --start;
  const auto number = parse_number(std::string_view(name).substr(start, end - start));
  if (!number) throw Error("'" + path + "': no time in its name; give the times with --times");
  return *number;
}

std::vector<double> times_of(const Options& options) {
  std::vector<double> times = options.times;
  std::string source = "--times";
  if (!options.times_csv.empty()) {
    times = read_csv(options.times_csv).column("t_s");
    source = "'" + options.times_csv + "'";
  } else if (times.empty()) {
    if (options.maps.size() == 1) return {0};
    for (const std::string& map : options.maps) times.push_back(time_in_name(map));
  }
  if (times.size() != options.maps.size())
    throw Error(
        fmt::format("{}: {} times for {} maps, must be one each", source, times.size(), options.maps.size()));
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw Error(fmt::format("'{}' at {:g} s: must be later than '{}' at {:g} s", options.maps[i], times[i],
                              options.maps[i - 1], times[i - 1]));
  return times;
}

double direction_of(const Options& options) {
  if (options.direction_deg) return degrees_to_radians(*options.direction_deg);
  if (options.from_deg) return direction_from_meteorological(*options.from_deg);
  const HeightMap last = read_geotiff(options.maps.back());
  const auto direction = likely_wind(last.geometry(), last.layer(layer::elevation));
  if (!direction)
    throw Error("'" + options.maps.back() +
                "': no ripples that stand out of its noise; give the wind with "
                "--direction-deg or --from-deg");
  return *direction;
}

RippleHistory follow(const Options& options, double direction, const std::vector<double>& times) {
  RippleTracker tracker(direction, 1e-3 * options.grain_mm);
  std::optional<GridGeometry> grid;
  for (std::size_t i = 0; i < options.maps.size(); ++i) {
    const HeightMap map = read_geotiff(options.maps[i]);
    if (!grid) grid = map.geometry();
    if (map.geometry() != *grid)
      throw Error("'" + options.maps[i] + "' lies on another grid than '" + options.maps.front() +
                  "'; all maps must have the same");
    const RippleField& field = tracker.add(map.geometry(), map.layer(layer::elevation), times[i]);
    if (field.crests == 0)
      fmt::print(stderr, "track_ripples: warning: '{}': no ripples that stand out of its noise\n",
                 options.maps[i]);
  }
  return tracker.history();
}

void draw(const Options& options, double direction, const RippleHistory& history) {
  for (std::size_t i = 0; i < options.maps.size(); ++i) {
    const HeightMap map = read_geotiff(options.maps[i]);
    CrestPicture(map.geometry(), map.layer(layer::elevation), history.maps[i])
        .write(options.out + "/" + stem(options.maps[i]) + "_crests.png");
    if (i == 0 && options.maps.size() > 1)
      TrackPicture(map.geometry(), direction).write(history, options.out + "/tracks.svg");
  }
}

void tell(const RippleHistory& history) {
  const TrackedMap& last = history.maps.back();
  const RippleField& f = last.field;
  fmt::print(
      "{:g} s: wavelength {:.1f} +- {:.1f} mm, height {:.2f} mm, index {:.1f}, stoss {:.1f} deg, lee {:.1f} "
      "deg, "
      "{} crests, {} ends\n",
      last.time, 1e3 * f.wavelength.value, 1e3 * f.wavelength.sigma, 1e3 * f.height.value, f.index.value,
      radians_to_degrees(f.stoss_max.value), radians_to_degrees(f.lee_max.value), f.crests,
      f.terminations + f.junctions);
  if (history.maps.size() < 2) return;
  const auto count = [&](RippleChange kind) {
    return std::count_if(history.events.begin(), history.events.end(),
                         [&](const RippleEvent& event) { return event.kind == kind; });
  };
  fmt::print("celerity {:.3g} +- {:.1g} mm/min; {} mergers, {} splits, {} repulsions, {} births, {} losses\n",
             6e4 * history.celerity.value, 6e4 * history.celerity.sigma, count(RippleChange::merger),
             count(RippleChange::split), count(RippleChange::repulsion), count(RippleChange::birth),
             count(RippleChange::loss));
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options options;
  app.add_option("MAP", options.maps, "height maps, in the order of time")->required();
  app.add_option("--out", options.out, "folder for the results, created when it does not exist")->required();
  auto* times =
      app.add_option("--times", options.times, "of the maps [s], separated by commas")->delimiter(',');
  app.add_option("--times-csv", options.times_csv, "file with the times of the maps in its column t_s")
      ->excludes(times);
  auto* to = app.add_option("--direction-deg", options.direction_deg,
                            "where the wind blows to, counter-clockwise from east");
  app.add_option("--from-deg", options.from_deg, "where the wind comes from, clockwise from north")
      ->excludes(to);
  app.add_option("--grain-mm", options.grain_mm, "grain diameter: ripples lower than half of it are none")
      ->check(CLI::NonNegativeNumber);
  if (const auto code = parse(app, argc, argv)) return *code;

  const std::vector<double> when = times_of(options);
  double direction = direction_of(options);
  RippleHistory history = follow(options, direction, when);
  if (!options.direction_deg && !options.from_deg) {
    if (history.celerity.value < 0) {  // ripples go with the wind, whatever their flanks look like
      direction = wrap_angle(direction + M_PI);
      history = follow(options, direction, when);
    }
    fmt::print("wind to {:.0f} deg (from {:.0f} deg), as the ripples tell\n", radians_to_degrees(direction),
               meteorological_from_direction(direction));
  }
  if (std::all_of(history.maps.begin(), history.maps.end(),
                  [](const TrackedMap& map) { return map.field.crests == 0; }))
    throw Error("no map has ripples that stand out of its noise");
  make_directory(options.out);
  write_ripples(history, options.out + "/ripples.csv");
  write_crests(history, options.out + "/crests.csv");
  write_crest_lines(history, options.out + "/crest_lines.csv");
  write_events(history, options.out + "/events.csv");
  draw(options, direction, history);
  tell(history);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("track_ripples", [&] { return aeolian::run(argc, argv); });
}
