// blow_surface: sand or snow blown over hard ground, forward in time.

#include <cmath>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/erosion/erosion_files.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/progress_bar.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Blows sand or snow over hard ground: grains lifted, carried, bounced and dropped in parcels, slides, bonds.

The ground is that of a scene (config/scenes) or any GeoTIFF; flags go before what the scene says. Models:
particles, every parcel flies through the wind; hop_table, flights are looked up, the fast one; thesis_compatible,
the literal loop of Szabo (2019).

Written to DIR: frame_NN.png and surface_NN.tif at even times, erosion.csv and erosion.svg (deviation, wavelength,
speed, bare share in time), summary.yaml.)";

struct Options {
  std::string scene_file, ground, material, wind, model, out;
  std::optional<double> loose_depth_mm, direction_deg, from_deg, minutes, temperature_c;
  int frames = 8;
  std::uint64_t seed = 1;
};

ErosionScene scene_of(const Options& o) {
  ErosionScene scene = o.scene_file.empty() ? ErosionScene{} : read_erosion_scene(o.scene_file);
  if (!o.material.empty()) set_material(scene, o.material);
  if (!o.wind.empty()) set_wind(scene, o.wind);
  if (!o.model.empty()) scene.model = o.model;
  if (o.loose_depth_mm) scene.cover.depth = *o.loose_depth_mm / 1000;
  if (o.direction_deg) scene.direction = degrees_to_radians(*o.direction_deg);
  if (o.from_deg) scene.direction = direction_from_meteorological(*o.from_deg);
  if (o.minutes) scene.minutes = *o.minutes;
  if (o.temperature_c) {
    if (!scene.snow) throw Error("--temperature-c: sand does not bond, must be with --material snow");
    scene.parameters.snow->temperature = *o.temperature_c;
  }
  return scene;
}

HeightMap surface_of(const Options& o, ErosionScene& scene) {
  HeightMap map;
  if (o.ground.empty()) {
    map = hard_terrain(scene.terrain, GridGeometry::covering(0, 0, scene.length, scene.width, scene.cell));
  } else {
    map = read_geotiff(o.ground);
    if (!map.has(layer::elevation) || count_known(map.layer(layer::elevation)) == 0)
      throw Error("'" + o.ground + "' has no known cell in a band elevation");
    map.add(layer::ground, HeightMap::Layer(map.layer(layer::elevation)));
    scene.terrain = o.ground;
    scene.parameters.border = Border::open;
  }
  cover(map, scene.cover, scene.grain().diameter, o.seed);
  return map;
}

void tell(const ErosionHistory& run, const ErosionScene& scene) {
  const ErosionMoment& last = run.moments.back();
  if (run.volume.moved == 0) {
    fmt::print("nothing moves: {:g} m/s at {:g} m is a friction velocity of {:.3f} m/s\n", scene.wind_speed,
               scene.wind_height, scene.wind().friction_velocity);
    return;
  }
  const std::string wavelength =
      std::isfinite(last.wavelength) ? fmt::format("{:.1f} cm", 100 * last.wavelength) : "none";
  fmt::print(
      "after {:g} min: deviation {:.2f} mm, wavelength {}, {:.0f} % bare; {:.3g} hops, {:.1f} s of computing "
      "({:.0f} times as fast as real time), volume error {:.1e}\n",
      scene.minutes, 1000 * last.deviation, wavelength, 100 * last.bare, static_cast<double>(run.counts.hops),
      run.computing_time, 60 * scene.minutes / run.computing_time, run.volume.error());
}

void blow(const Options& o, const std::string& command) {
  ErosionScene scene = scene_of(o);
  HeightMap map = surface_of(o, scene);
  ParticleErosion model(scene.chosen_parameters(o.seed));
  make_directory(o.out);
  ProgressBar bar;
  const double duration = 60 * scene.minutes;
  const std::unique_ptr<WindModel> wind = scene.wind_model();
  const ErosionHistory run = run_erosion(
      map, model, {*wind, scene.wind_input(), scene.terrain_wind}, scene.grain(), duration, o.frames,
      [&](const HeightMap& kept, int frame) {
        const double minutes = scene.minutes * frame / o.frames;
        const std::string title =
            fmt::format("{} after {:.3g} min of {:g} m/s at {:g} m, to {:.0f} deg from east",
                        scene.snow ? "snow" : "sand", minutes, scene.wind_speed, scene.wind_height,
                        radians_to_degrees(scene.direction));
        draw_surface(kept, scene.grain(), scene.snow, title,
                     fmt::format("{}/frame_{:02d}.png", o.out, frame));
        write_geotiff(kept, fmt::format("{}/surface_{:02d}.tif", o.out, frame));
      },
      [&](double share) { bar.at(share, "blowing"); });
  write_erosion_history(run, o.out);
  plot_erosion_history(run, o.out);
  write_erosion_summary(run, scene, o.seed, command, o.out);
  bar.clear();
  tell(run, scene);
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options o;
  CLI::Option* scene = app.add_option("--scene", o.scene_file, "YAML file, as in config/scenes");
  app.add_option("--ground", o.ground, "GeoTIFF of hard ground; open borders")->excludes(scene);
  app.add_option("--loose-depth-mm", o.loose_depth_mm, "of sand or snow on it")->check(CLI::Range(0.0, 1e5));
  app.add_option("--material", o.material, "sand or snow")->check(CLI::IsMember({"sand", "snow"}));
  app.add_option("--wind", o.wind, "SPEED@HEIGHT in m/s and m, like 12@10");
  CLI::Option* direction = app.add_option("--direction-deg", o.direction_deg,
                                          "where the wind blows to, counter-clockwise from east")
                               ->check(CLI::Range(-360.0, 360.0));
  app.add_option("--from-deg", o.from_deg, "or where it comes from, clockwise from north")
      ->check(CLI::Range(-360.0, 360.0))
      ->excludes(direction);
  app.add_option("--minutes", o.minutes, "of wind")->check(CLI::Range(1e-3, 1e6));
  app.add_option("--temperature-c", o.temperature_c, "of snow")->check(CLI::Range(-90.0, 50.0));
  app.add_option("--model", o.model, "particles, hop_table or thesis_compatible")
      ->check(CLI::IsMember({"particles", "hop_table", "thesis_compatible"}));
  app.add_option("--frames", o.frames, "pictures and maps after the first")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "decides everything random")->capture_default_str();
  app.add_option("--out", o.out, "folder for the results")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  blow(o, typed_command("blow_surface", argc, argv));
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("blow_surface", [&] { return aeolian::run(argc, argv); });
}
