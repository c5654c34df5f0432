#pragma once

#include <string>
#include <vector>

#include "aeolian_core/wind/wind_probe.hpp"

namespace aeolian {

/// The wind over a map and how it came about.
struct TerrainWindRun {
  HeightMap map;
  std::string projection;  ///< of the map, as GDAL takes it
  WindInput anemometer;
  double roughness = 0;  ///< [m]
  bool chosen = true;    ///< the model, by the program
  double steepness = 0;  ///< of the relief that the wind feels
  double shortest = 0;   ///< waves are ground, shorter ones roughness [m]
  WindField field;
};

/// A point at which the wind is asked for.
struct ProbePoint {
  MapPoint place;
  double height = 0;  ///< over the ground [m]
};

/// Reads columns x_m, y_m, height_m. Throws Error naming file and row for what is not finite or a height that
/// is not positive.
std::vector<ProbePoint> read_probes(const std::string& path);

/// Writes wind.tif: friction_velocity [m/s], direction [rad], separated, speed_up (friction velocity over
/// that of the surroundings, less one).
void write_wind_layers(const TerrainWindRun& run, const std::string& folder);
/// Writes probes.csv: the points and what is known of the wind there.
void write_probe_readings(const std::vector<ProbePoint>& points, const std::vector<ProbeReading>& readings,
                          const std::string& folder);
/// Writes summary.yaml.
void write_wind_summary(const TerrainWindRun& run, const std::string& folder);

/// Friction velocity over that of the surroundings, less one, of each cell; zero everywhere where the wind is
/// the same everywhere.
HeightMap::Layer speed_up(const TerrainWindRun& run);

}  // namespace aeolian
