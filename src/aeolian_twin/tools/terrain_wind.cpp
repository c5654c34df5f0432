// terrain_wind: the wind over a map from one anemometer: at the ground, and at points of the air.

#include "aeolian_core/wind/terrain_wind.hpp"

#include <algorithm>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/inner_layer.hpp"
#include "aeolian_twin/terrain/wind_files.hpp"
#include "aeolian_twin/terrain/wind_picture.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(The wind over a map (GeoTIFF with a band elevation [m]), from what one anemometer says.

Models: log (the same everywhere), spectral (linear theory: slopes up to 0.3, with the air separated behind steep lees),
mass_consistent (steep relief, cliffs); only when asked for: sph (a box of air made of particles) and thesis_compatible
(that of Dobusch 2016 with its defects, for comparison only); auto takes the one of the others that suits the relief. Without --anemometer the reading is that
of level surroundings of the map; with it, the surroundings are found of which the relief makes that reading.

Written to DIR: wind.tif (friction velocity, direction, separated air, speed-up), speed_up.png, summary.yaml, and with
--probes (CSV with columns x_m, y_m, height_m over the ground) probes.csv: velocity, lift and turbulence at each point.)";

struct Options {
  std::string map;
  double speed = 0;
  double height = 2;
  double direction_deg = 0;
  std::optional<double> from_deg;
  std::vector<double> anemometer;
  double roughness = 1e-5;
  std::string model = "auto";
  std::string probes;
  std::string out;
};

std::vector<ProbeReading> probe(const TerrainWind& model, const TerrainWindRun& run,
                                const std::vector<ProbePoint>& points) {
  double top = 0;
  for (const ProbePoint& p : points) top = std::max(top, p.height);
  const WindProbe probe(run.field, model.volume(run.map, run.field.direction, 1.2 * top), run.roughness,
                        inner_depth_over(run.map.geometry(), run.roughness));
  std::vector<ProbeReading> readings;
  for (const ProbePoint& p : points) readings.push_back(probe.at(p.place, p.height));
  return readings;
}

void blow(const Options& o) {
  TerrainWindRun run;
  run.map = read_geotiff(o.map);
  if (!run.map.has(layer::elevation) || count_known(run.map.layer(layer::elevation)) == 0)
    throw Error("'" + o.map + "' has no known cell in a band elevation");
  run.projection = read_geotiff_projection(o.map);
  run.anemometer.speed = o.speed;
  run.anemometer.height = o.height;
  run.anemometer.direction =
      o.from_deg ? direction_from_meteorological(*o.from_deg) : degrees_to_radians(o.direction_deg);
  if (!o.anemometer.empty()) run.anemometer.place = MapPoint{o.anemometer[0], o.anemometer[1]};
  run.roughness = o.roughness;
  run.chosen = o.model == "auto";
  const std::vector<ProbePoint> points = o.probes.empty() ? std::vector<ProbePoint>{} : read_probes(o.probes);

  TerrainWindSettings settings;
  settings.relief.roughness = o.roughness;
  settings.backend = backend_of(o.model);
  settings.sector = 0;
  settings.thesis.air.wind = o.speed;
  settings.thesis.height = o.height;
  TerrainWind model(settings);
  run.shortest = std::max(settings.relief.shortest(), 4 * run.map.geometry().cell());
  run.steepness = steepness(wind_relief(run.map, run.shortest));
  run.field = model.solve(run.anemometer, &run.map);
  std::vector<ProbeReading> readings;
  if (!points.empty()) readings = probe(model, run, points);

  make_directory(o.out);
  write_wind_layers(run, o.out);
  draw_speed_up(run, o.out);
  if (!points.empty()) write_probe_readings(points, readings, o.out);
  write_wind_summary(run, o.out);
  const HeightMap::Layer gains = speed_up(run);
  float least = INFINITY;
  float most = -INFINITY;
  for (const float gain : gains)
    if (std::isfinite(gain)) {
      least = std::min(least, gain);
      most = std::max(most, gain);
    }
  fmt::print("{}: friction velocity of the surroundings {:.3f} m/s, on the map {:+.0f} to {:+.0f} %\n",
             run.field.model, run.field.friction_velocity, 100 * least, 100 * most);
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options o;
  app.add_option("--map", o.map, "GeoTIFF with a band elevation")->required();
  app.add_option("--speed", o.speed, "of the anemometer [m/s]")->required()->check(CLI::Range(0.0, 100.0));
  app.add_option("--height", o.height, "of the anemometer over the ground [m]")->capture_default_str();
  CLI::Option* direction = app.add_option("--direction-deg", o.direction_deg,
                                          "where the wind blows to, counter-clockwise from east")
                               ->check(CLI::Range(-360.0, 360.0));
  app.add_option("--from-deg", o.from_deg, "where it comes from, clockwise from north")
      ->check(CLI::Range(-360.0, 360.0))
      ->excludes(direction);
  app.add_option("--anemometer", o.anemometer, "where it stands: X Y in the frame of the map [m]")
      ->expected(2);
  app.add_option("--roughness", o.roughness, "aerodynamic roughness length of the ground [m]")
      ->check(CLI::Range(1e-8, 10.0))
      ->capture_default_str();
  app.add_option("--model", o.model, "auto, log, spectral, mass_consistent, sph or thesis_compatible")
      ->check(CLI::IsMember({"auto", "log", "spectral", "mass_consistent", "sph", "thesis_compatible"}))
      ->capture_default_str();
  app.add_option("--probes", o.probes, "CSV of points in the air");
  app.add_option("--out", o.out, "folder for the results")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  blow(o);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("terrain_wind", [&] { return aeolian::run(argc, argv); });
}
