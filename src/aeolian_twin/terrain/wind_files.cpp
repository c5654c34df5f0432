#include "aeolian_twin/terrain/wind_files.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"

namespace aeolian {

std::vector<ProbePoint> read_probes(const std::string& path) {
  const Table table = read_csv(path);
  for (const char* name : {"x_m", "y_m", "height_m"})
    if (!table.has(name)) throw Error("probes " + path + ": there is no column " + name);
  std::vector<ProbePoint> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const ProbePoint p{{table.column("x_m")[row], table.column("y_m")[row]}, table.column("height_m")[row]};
    if (!std::isfinite(p.place.x) || !std::isfinite(p.place.y))
      throw Error(fmt::format("probes {}, row {}: x_m, y_m are {:g}, {:g}, must be finite", path, row + 1,
                              p.place.x, p.place.y));
    if (!(p.height > 0) || !std::isfinite(p.height))
      throw Error(
          fmt::format("probes {}, row {}: height_m is {:g}, must be positive", path, row + 1, p.height));
    points.push_back(p);
  }
  if (points.empty()) throw Error("probes " + path + ": there is no point");
  return points;
}

HeightMap::Layer speed_up(const TerrainWindRun& run) {
  const std::size_t n = run.map.geometry().size();
  const HeightMap& cells = run.field.cells;
  if (!cells.has("friction_velocity") || !(run.field.friction_velocity > 0)) return HeightMap::Layer(n, 0);
  HeightMap::Layer ratio = cells.layer("friction_velocity");
  for (float& value : ratio) value = value / static_cast<float>(run.field.friction_velocity) - 1;
  return ratio;
}

void write_wind_layers(const TerrainWindRun& run, const std::string& folder) {
  HeightMap layers = run.field.cells;
  if (layers.names().empty()) {
    layers = HeightMap(run.map.geometry());
    layers.add("friction_velocity", static_cast<float>(run.field.friction_velocity));
    layers.add("direction", static_cast<float>(run.field.direction));
    layers.add("separated", 0);
  }
  layers.add("speed_up", speed_up(run));
  write_geotiff(layers, folder + "/wind.tif", run.projection,
                {{"model", run.field.model}, {"direction", "blows to, counter-clockwise from east, rad"}});
}

void write_probe_readings(const std::vector<ProbePoint>& points, const std::vector<ProbeReading>& readings,
                          const std::string& folder) {
  Table table{{"x_m", "y_m", "height_m", "speed_m_s", "direction_deg", "east_m_s", "north_m_s", "lift_m_s",
               "friction_velocity_m_s", "turbulence_intensity", "sigma_along_m_s", "sigma_across_m_s",
               "sigma_up_m_s", "separated"},
              std::vector<std::vector<double>>(14)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ProbeReading& r = readings[i];
    const double row[] = {points[i].place.x,
                          points[i].place.y,
                          points[i].height,
                          std::hypot(r.mean.east, r.mean.north),
                          radians_to_degrees(std::atan2(r.mean.north, r.mean.east)),
                          r.mean.east,
                          r.mean.north,
                          r.mean.up,
                          r.friction_velocity,
                          std::isfinite(r.intensity) ? r.intensity : NAN,
                          r.friction_velocity * kaimal_deviation(GustComponent::along),
                          r.friction_velocity * kaimal_deviation(GustComponent::across),
                          r.friction_velocity * kaimal_deviation(GustComponent::up),
                          r.separated ? 1.0 : 0.0};
    for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].push_back(row[c]);
  }
  write_csv(table, folder + "/probes.csv");
}

void write_wind_summary(const TerrainWindRun& run, const std::string& folder) {
  const HeightMap::Layer ratio = speed_up(run);
  double least = INFINITY;
  double most = -INFINITY;
  double separated = 0;
  for (const float r : ratio)
    if (std::isfinite(r)) {
      least = std::min(least, static_cast<double>(r));
      most = std::max(most, static_cast<double>(r));
    }
  if (run.field.cells.has("separated"))
    for (const float s : run.field.cells.layer("separated")) separated += s > 0 ? 1 : 0;
  YAML::Emitter out;
  out.SetDoublePrecision(summary_digits);
  out << YAML::BeginMap;
  put(out, "model", run.field.model);
  put(out, "model_chosen_by", run.chosen ? "the relief" : "--model");
  put(out, "steepness", run.steepness);
  put(out, "shortest_wavelength_m", run.shortest);
  put(out, "roughness_m", run.roughness);
  put(out, "anemometer_speed_m_s", run.anemometer.speed);
  put(out, "anemometer_height_m", run.anemometer.height);
  put(out, "anemometer_direction_deg", radians_to_degrees(wrap_angle(run.anemometer.direction)));
  put(out, "surroundings_friction_velocity_m_s", run.field.friction_velocity);
  put(out, "surroundings_direction_deg", radians_to_degrees(run.field.direction));
  put(out, "speed_up_least", least);
  put(out, "speed_up_most", most);
  put(out, "separated_share", separated / static_cast<double>(ratio.size()));
  out << YAML::EndMap;
  write_text_atomically(folder + "/summary.yaml", std::string(out.c_str()) + "\n");
}

}  // namespace aeolian
