// compare_surfaces: how two surfaces from files differ, with uncertainties.

#include <cmath>
#include <map>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/comparison/compared_surfaces.hpp"
#include "aeolian_twin/comparison/surface_files.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Compares two surfaces: A (predicted, or later) with B (measured, or earlier). Differences are A minus B.

Surfaces: GeoTIFF, bag (FILE.bag:TOPIC, the last grid map of the topic), clouds (PCD, PLY, XYZ, CSV, TXT), or two
profiles (CSV with columns x_m, z_m). Clouds are gridded on the other surface's grid or in cells of --cell; maps of
different cells are compared on the coarser.

Written to DIR: index.html (read it first), comparison.yaml, difference.tif (difference, lod95, displacement),
coherence.csv, scales.csv and the pictures.)";

struct Options {
  std::string a, b, initial, stable, out;
  std::optional<CoRegistration> method;
  std::string method_name = "none";
  std::optional<double> max_shift, cell, from_deg, sigma_a, sigma_b;
  double direction_deg = 0;
};

constexpr double cells_of_shift = 25;

ComparedSurfaces compare_files(const Options& options) {
  std::vector<SurfaceFile> files{read_surface(options.a), read_surface(options.b)};
  if (!options.initial.empty()) files.push_back(read_surface(options.initial));
  CommonGrid common = on_common_grid(files, options.cell);

  ComparedSurfaces compared;
  compared.name_a = options.a;
  compared.name_b = options.b;
  compared.name_start = options.initial;
  compared.profile = common.profile;
  compared.direction = options.from_deg ? direction_from_meteorological(*options.from_deg)
                                        : degrees_to_radians(options.direction_deg);
  if (common.profile && std::abs(std::sin(compared.direction)) > 1e-9)
    throw Error("a profile runs along x: --direction-deg must be 0 or 180");
  compared.remarks = std::move(common.remarks);
  for (const SurfaceFile& file : files)
    if (compared.projection.empty()) compared.projection = file.projection;
  compared.a = std::move(common.maps[0]);
  compared.b = std::move(common.maps[1]);
  const GridGeometry& grid = compared.b.geometry();

  ComparisonSettings settings;
  settings.direction = compared.direction;
  settings.sigma_a = options.sigma_a;
  settings.sigma_b = options.sigma_b;
  HeightMap::Layer stable;
  if (!options.stable.empty()) {
    stable = read_mask(options.stable, grid);
    settings.stable = &stable;
    compared.stable_ground = true;
  }
  if (options.method) {
    if (common.profile) throw Error("--co-register: profiles are not moved, surfaces are");
    compared.method = options.method_name;
    compared.registered =
        co_register(compared.a, compared.b, *options.method,
                    options.max_shift.value_or(cells_of_shift * grid.cell()), settings.stable);
    compared.a = compared.registered->map;
    settings.common_sigma = compared.registered->up.sigma;
  }
  compared.comparison =
      compare_surfaces(compared.a, compared.b, common.maps.size() > 2 ? &common.maps[2] : nullptr, settings);
  return compared;
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options o;
  app.add_option("A", o.a, "first surface: predicted, or later")->required();
  app.add_option("B", o.b, "second surface: measured, or earlier")->required();
  app.add_option("--initial", o.initial, "surface from which A was predicted: migration and skill are told");
  app.add_option("--co-register", o.method_name, "lay A onto B first: none, shift, plane or rigid")
      ->check(CLI::IsMember({"none", "shift", "plane", "rigid"}))
      ->capture_default_str();
  app.add_option("--max-shift", o.max_shift, "farthest that a point of A may be moved [m]; without: 25 cells")
      ->check(CLI::PositiveNumber);
  app.add_option("--stable", o.stable, "GeoTIFF, above 0.5 where the ground did not change");
  CLI::Option* direction = app.add_option("--direction-deg", o.direction_deg,
                                          "where the wind blows to, counter-clockwise from east")
                               ->check(CLI::Range(-360.0, 360.0))
                               ->capture_default_str();
  app.add_option("--from-deg", o.from_deg, "or where it comes from, clockwise from north")
      ->check(CLI::Range(-360.0, 360.0))
      ->excludes(direction);
  app.add_option("--cell", o.cell, "side of the cells to compare in [m]")->check(CLI::PositiveNumber);
  app.add_option("--sigma-a", o.sigma_a, "standard deviation of A's heights [m], where it has no variances")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--sigma-b", o.sigma_b, "of B's [m]")->check(CLI::NonNegativeNumber);
  app.add_option("--out", o.out, "folder for the results")->required();
  if (const auto code = parse(app, argc, argv)) return *code;
  const std::map<std::string, CoRegistration> methods{
      {"shift", CoRegistration::shift}, {"plane", CoRegistration::plane}, {"rigid", CoRegistration::rigid}};
  if (const auto method = methods.find(o.method_name); method != methods.end()) o.method = method->second;

  const ComparedSurfaces compared = compare_files(o);
  make_directory(o.out);
  write_comparison(compared, o.out);
  write_comparison_page(compared, draw_comparison(compared, o.out), o.out);
  fmt::print("{}", summary(compared));
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("compare_surfaces", [&] { return aeolian::run(argc, argv); });
}
