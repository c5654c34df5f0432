// grow_ripples: wind ripples on a measured or a level bed, forward in time.

#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/bedforms/bedforms.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/preview.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/ripples/ripple_run_files.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Grows wind ripples on a bed of sand.

The bed is a map (GeoTIFF with a band elevation [m], and ground [m] where hard ground lies under the sand) or level and
screeded. Models: height_map, the one that forecasts; lattice, a bed of single grains, the slow truth; haff, Haff's
height bins, for winds along an axis of the map. A level bed is periodic, a map has open borders, unless --border says
otherwise; beds of grains are periodic. With --coarse-fraction the height-map model has sand of two sizes, which it sorts.
Ripples of the height-map model are as flat as nature's and stop growing where --wavelength-law says.

Written to DIR: elevation_SSSS.tif every --map-every-s, ripples.csv and ripples.svg (wavelength, height, slopes, speed in
time), sections.svg (the bed along the wind at several times), map.png (the bed at the end).)";

constexpr double natural_doubling_slope = 4 * M_PI / 180;  ///< makes ripples of index 15 to 20
constexpr double final_diameters = 250;                    ///< wavelength at which ripples stop growing
constexpr double noisy_share = 0.1;  ///< of the cells that draw the noise of single grains in a step

struct Options {
  std::string bed;
  std::string flat;
  double friction_velocity = 0;
  double direction_deg = 0;
  std::optional<double> from_deg;
  double minutes = 10;
  double grain_diameter_mm = 0.25;
  double map_every = 60;
  std::string model = "height_map";
  std::string wavelength_law = "constant";
  double coarse_fraction = 0;
  double coarse_diameter_mm = 0.6;
  std::optional<Border> border;
  std::uint64_t seed = 1;
  std::string out;
};

/// The grid of LENGTHxWIDTH@CELL [m].
GridGeometry flat_grid(const std::string& text) {
  const auto cross = text.find('x');
  const auto at = text.find('@');
  if (cross != std::string::npos && at != std::string::npos && cross < at) {
    const auto length = parse_number(text.substr(0, cross));
    const auto width = parse_number(text.substr(cross + 1, at - cross - 1));
    const auto cell = parse_number(text.substr(at + 1));
    if (length && width && cell && *cell > 0 && *length >= 4 * *cell && *width >= 4 * *cell &&
        *length / *cell * (*width / *cell) <= 1e8)
      return GridGeometry::covering(0, 0, *length, *width, *cell);
  }
  throw Error(
      "--flat: '" + text +
      "' must be LENGTHxWIDTH@CELL in metres, at least 4 cells long and wide, at most 1e8 cells, like "
      "1.0x0.5@0.002");
}

HeightMap starting_bed(const Options& options, const Grain& grain) {
  if (options.bed.empty())
    return screeded_bed(flat_grid(options.flat.empty() ? "1.0x0.5@0.002" : options.flat), grain,
                        options.seed);
  HeightMap map = read_geotiff(options.bed);
  if (!map.has(layer::elevation) || count_known(map.layer(layer::elevation)) == 0)
    throw Error("'" + options.bed + "' has no known cell in a band elevation");
  return map;
}

std::unique_ptr<BedModel> model_of(const Options& options) {
  if (options.model != "height_map" && options.coarse_fraction > 0)
    throw Error("--coarse-fraction: the model " + options.model + " has one size, must be height_map");
  if (options.model != "height_map" && options.border == Border::open)
    throw Error("--border: open, must be periodic for the model " + options.model);
  if (options.model == "lattice") return std::make_unique<LatticeModel>(LatticeParameters{}, options.seed);
  if (options.model == "haff") return std::make_unique<HaffModel>(HaffModelParameters{}, options.seed);
  RippleParameters parameters;
  parameters.border = options.border.value_or(options.bed.empty() ? Border::periodic : Border::open);
  parameters.doubling_slope = natural_doubling_slope;
  if (options.coarse_fraction > 0) {
    SortedRippleParameters sorted;
    sorted.ripples = parameters;
    sorted.coarse_fraction = options.coarse_fraction;
    sorted.coarse_diameter = options.coarse_diameter_mm / 1000;
    return std::make_unique<SortedRippleModel>(sorted);
  }
  parameters.wavelength_law = make_wavelength_law(options.wavelength_law, final_diameters);
  parameters.stochastic_share = noisy_share;
  parameters.seed = options.seed;
  return std::make_unique<RippleModel>(parameters);
}

void tell(const RippleRun& run, const Forcing& forcing, const RippleRunSettings& settings) {
  const RippleMoment& last = run.moments.back();
  if (forcing.ejection_rate == 0)
    fmt::print("u* {:g} m/s is below the impact threshold: nothing moves\n", forcing.friction_velocity);
  else if (!std::isfinite(last.ripples.wavelength))
    fmt::print("after {:g} min no ripples can be told from noise\n", settings.duration / 60);
  else
    fmt::print(
        "after {:g} min: ripples of {:.1f} cm, {:.1f} mm high (index {:.0f}), moving {:.1f} cm/min; "
        "{:.0f} times as fast as real time\n",
        settings.duration / 60, 100 * last.ripples.wavelength, 1000 * last.ripples.height, last.ripples.index,
        6000 * last.speed, settings.duration / run.computing_time);
}

void grow(const Options& options) {
  Grain grain;
  grain.diameter = options.grain_diameter_mm / 1000;
  RippleRunSettings settings;
  settings.duration = 60 * options.minutes;
  settings.map_every = options.map_every;
  const double direction = options.from_deg ? direction_from_meteorological(*options.from_deg)
                                            : degrees_to_radians(options.direction_deg);
  settings.forcing =
      make_forcing(steady_saltation(options.friction_velocity, grain), direction, grain, MeanSplash{});
  HeightMap map = starting_bed(options, grain);
  const std::unique_ptr<BedModel> model = model_of(options);

  make_directory(options.out);
  std::vector<WindSection> sections;
  ProgressBar bar;
  const RippleRun run = run_ripples(
      map, *model, settings,
      [&](const HeightMap& kept, double time) {
        write_geotiff(kept, fmt::format("{}/elevation_{:04.0f}.tif", options.out, time));
        sections.push_back(middle_section(kept, direction, time));
      },
      [&](double share) { bar.at(share, "ripples"); });
  write_ripple_history(run, options.out);
  plot_ripple_history(run, options.out);
  plot_sections(sections, options.out);
  PreviewOptions preview;
  preview.title =
      fmt::format("after {:g} min, friction velocity {:g} m/s", options.minutes, options.friction_velocity);
  preview.exaggeration = 4;
  write_preview(map, options.out + "/map.png", preview);
  bar.clear();
  tell(run, settings.forcing, settings);
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options o;
  CLI::Option* bed = app.add_option("--bed", o.bed, "GeoTIFF to start from");
  app.add_option("--flat", o.flat, "level bed, LENGTHxWIDTH@CELL [m], default 1.0x0.5@0.002")->excludes(bed);
  app.add_option("--friction-velocity", o.friction_velocity, "[m/s]")
      ->required()
      ->check(CLI::Range(0.0, 10.0));
  CLI::Option* direction = app.add_option("--direction-deg", o.direction_deg,
                                          "where the wind blows to, counter-clockwise from east")
                               ->check(CLI::Range(-360.0, 360.0))
                               ->capture_default_str();
  app.add_option("--from-deg", o.from_deg, "or where it comes from, clockwise from north")
      ->check(CLI::Range(-360.0, 360.0))
      ->excludes(direction);
  app.add_option("--minutes", o.minutes, "of wind")->check(CLI::Range(1e-3, 1e6))->capture_default_str();
  app.add_option("--grain-diameter-mm", o.grain_diameter_mm, "of the sand")
      ->check(CLI::Range(0.05, 5.0))
      ->capture_default_str();
  app.add_option("--model", o.model, "height_map, lattice or haff")
      ->check(CLI::IsMember({"height_map", "lattice", "haff"}))
      ->capture_default_str();
  app.add_option("--border", o.border, "periodic or open")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Border>{{"periodic", Border::periodic}, {"open", Border::open}}));
  CLI::Option* law =
      app.add_option("--wavelength-law", o.wavelength_law,
                     "where ripples stop growing: none, constant (250 grain diameters) or linear in the wind")
          ->check(CLI::IsMember({"none", "constant", "linear"}))
          ->capture_default_str();
  CLI::Option* coarse = app.add_option("--coarse-fraction", o.coarse_fraction, "of the sand's volume")
                            ->check(CLI::Range(0.0, 1.0))
                            ->excludes(law);
  app.add_option("--coarse-diameter-mm", o.coarse_diameter_mm, "of the coarse grains")
      ->check(CLI::Range(0.05, 20.0))
      ->capture_default_str()
      ->needs(coarse);
  app.add_option("--map-every-s", o.map_every, "time between maps that are written")
      ->check(CLI::Range(1.0, 1e7))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "decides everything random")->capture_default_str();
  app.add_option("--out", o.out, "folder for the results")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  grow(o);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("grow_ripples", [&] { return aeolian::run(argc, argv); });
}
