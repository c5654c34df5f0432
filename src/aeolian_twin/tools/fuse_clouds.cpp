// fuse_clouds: files of points to one height map, by the fusion of height_mapper.

#include <cstdio>
#include <map>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <unistd.h>

#include "aeolian_core/measure/cloud_sample.hpp"
#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/sensor_file.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Fuses point clouds into a height map: a GeoTIFF with the bands elevation [m], variance [m^2] and count.

Clouds: PCD, PLY, XYZ, CSV, TXT or GeoTIFF, in one frame with z up; they are taken as one scan of one surface, and the
map does not depend on their order. Where coordinates exceed 1000 m they are georeferenced: each height has the
standard deviation range_sigma_m of the sensor. Otherwise the sensor is taken to stand in the origin of the coordinates.

By default every point counts, by its inverse variance. With --robust a cell gets the height of its lowest surface:
plants, roofs, flying pixels and grains in flight above it are dropped, and so are stray points below it.

With --register each cloud after the first is laid onto the map of those before it, so their order counts. A cloud that
would move by more than --max-shift or turn by more than 2 degrees, that hardly overlaps the map or that comes no nearer
to it, is fused as it is, with a warning.)";

struct Options {
  std::vector<std::string> clouds;
  double cell = 0.002;
  std::string out;
  std::string sensor;
  std::vector<double> bounds;
  bool robust = false;
  std::optional<RegistrationMethod> method;
  std::optional<double> max_shift;
};

constexpr double most_cells = 4e8;
constexpr double farthest = 1000;  // of a sensor that nobody named [m]
constexpr double cells_of_shift = 25;

/// How far the work is, on a terminal only.
class Progress {
 public:
  explicit Progress(std::size_t clouds) : clouds_(clouds), shown_(isatty(STDERR_FILENO) != 0) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const char* what, std::size_t number, std::size_t points) const {
    if (shown_) fmt::print(stderr, "\r\033[K{} cloud {} of {}, {} points", what, number, clouds_, points);
  }
  void clear() const {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  std::size_t clouds_;
  bool shown_;
};

struct Box {
  double min_x = INFINITY, min_y = INFINITY, max_x = -INFINITY, max_y = -INFINITY;

  void extend(const PointCloud& cloud) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d point = true_point(cloud, i);
      if (!point.allFinite()) continue;
      min_x = std::min(min_x, point.x());
      min_y = std::min(min_y, point.y());
      max_x = std::max(max_x, point.x());
      max_y = std::max(max_y, point.y());
    }
  }
};

Box bounds_of(const Options& options, const Progress& progress) {
  Box box;
  if (!options.bounds.empty()) {
    const auto& b = options.bounds;
    if (!(b[0] < b[2] && b[1] < b[3]))
      throw Error(
          fmt::format("--bounds: {},{},{},{} is empty, must be xmin,ymin,xmax,ymax with xmin < xmax and "
                      "ymin < ymax",
                      b[0], b[1], b[2], b[3]));
    return {b[0], b[1], b[2], b[3]};
  }
  std::size_t points = 0;
  for (std::size_t i = 0; i < options.clouds.size(); ++i) {
    progress.show("measuring", i + 1, points);
    const PointCloud cloud = read_cloud(options.clouds[i]);
    box.extend(cloud);
    points += cloud.size();
  }
  return box;
}

GridGeometry grid_of(const Options& options, const Progress& progress) {
  const Box box = bounds_of(options, progress);
  // Cells are half open: a point on the far border is inside the next.
  const double margin = options.bounds.empty() ? 1e-3 * options.cell : 0;
  const double cells = (box.max_x - box.min_x + options.cell) * (box.max_y - box.min_y + options.cell) /
                       (options.cell * options.cell);
  if (!(cells <= most_cells))
    throw Error(
        fmt::format("a map of {:g} m x {:g} m in cells of {:g} m has {:.3g} cells, at most {:g} are allowed "
                    "(a larger --cell or smaller --bounds)",
                    box.max_x - box.min_x, box.max_y - box.min_y, options.cell, cells, most_cells));
  return GridGeometry::covering(box.min_x, box.min_y, box.max_x + margin, box.max_y + margin, options.cell);
}

FusionParameters parameters_of(const Options& options) {
  FusionParameters parameters;
  parameters.robust = options.robust;
  parameters.sensor.max_range = farthest;
  if (!options.sensor.empty()) {
    const SensorFile sensor = read_sensor_file(options.sensor);
    parameters.sensor = sensor.noise;
  }
  return parameters;
}

/// The pose that lays a cloud onto the map, or none with a warning; says what it did.
Eigen::Isometry3d registered(const std::string& name, const PointCloud& cloud, const HeightMap& map,
                             const Options& options) {
  RegistrationParameters parameters;
  parameters.method = *options.method;
  parameters.max_shift = options.max_shift.value_or(cells_of_shift * options.cell);
  parameters.max_distance = parameters.max_shift;
  const Registration result = register_cloud(cloud, Eigen::Isometry3d::Identity(), map, parameters);
  if (result.accepted)
    fmt::print(
        "{}: moved by up to {:.3g} m, turned by {:.3g} deg ({} of 6 directions held by the surface), median "
        "distance from the map {:.3g} m, before {:.3g} m\n",
        name, result.shift, radians_to_degrees(result.angle), result.held, result.median_residual,
        result.given_residual);
  else
    fmt::print(stderr, "fuse_clouds: warning: {}: fused as it is: {}\n", name, result.reason);
  return result.pose;
}

void fuse(const Options& options) {
  const FusionParameters parameters = parameters_of(options);
  std::optional<Progress> progress(options.clouds.size());
  HeightFusion fusion(grid_of(options, *progress), parameters);
  FusionResult total;
  std::size_t points = 0;
  for (std::size_t i = 0; i < options.clouds.size(); ++i) {
    progress->show("fusing", i + 1, points);
    const PointCloud cloud = read_cloud(options.clouds[i]);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (options.method && i > 0) {
      progress->clear();
      pose = registered(options.clouds[i], cloud, fusion.map(), options);
    }
    const FusionResult result = fusion.add(cloud, pose, 0);
    points += cloud.size();
    total.used += result.used;
    total.not_finite += result.not_finite;
    total.out_of_range += result.out_of_range;
    total.outside += result.outside;
  }
  progress.reset();
  const std::string fate = fmt::format("{} not finite, {} out of range, {} out of bounds", total.not_finite,
                                       total.out_of_range, total.outside);
  if (total.used == 0) throw Error(fmt::format("none of {} points can be used: {}", points, fate));

  HeightMap map(fusion.map().geometry());
  map.add(layer::elevation, fusion.map().layer(layer::elevation));
  map.add(layer::variance, fusion.map().layer(layer::variance));
  map.add("count", fusion.counts());
  write_geotiff(map, options.out);
  fmt::print("{}: {} x {} cells, {} known, from {} of {} points ({})\n", options.out, map.geometry().nx(),
             map.geometry().ny(), count_known(map.layer(layer::elevation)), total.used, points, fate);
}

int run(int argc, char** argv) {
  CLI::App app(description);
  Options options;
  app.add_option("CLOUD", options.clouds, "files of points")->required();
  app.add_option("--cell", options.cell, "side of a cell [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--out", options.out, "GeoTIFF to write")->required();
  app.add_flag("--robust", options.robust, "the lowest surface of each cell");
  app.add_option("--sensor", options.sensor, "noise and ranges of the sensor: a file of config/sensors");
  app.add_option("--bounds", options.bounds, "xmin,ymin,xmax,ymax of the map [m]; without: of the points")
      ->delimiter(',')
      ->expected(4);
  app.add_option("--register", options.method, "lay each cloud onto the map of those before it")
      ->transform(CLI::CheckedTransformer(std::map<std::string, RegistrationMethod>{
          {"icp", RegistrationMethod::icp}, {"ndt", RegistrationMethod::ndt}}));
  app.add_option("--max-shift", options.max_shift,
                 "farthest that --register may move a point [m]; without: 25 cells")
      ->check(CLI::PositiveNumber)
      ->needs("--register");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  fuse(options);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  try {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return aeolian::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuse_clouds: %s\n", error.what());
    return 1;
  }
}
