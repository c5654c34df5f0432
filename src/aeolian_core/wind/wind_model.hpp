#pragma once

#include <optional>
#include <string>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A point of the map [m].
struct MapPoint {
  double x = 0;
  double y = 0;
  friend bool operator==(const MapPoint& a, const MapPoint& b) { return a.x == b.x && a.y == b.y; }
};

/// What an anemometer says.
struct WindInput {
  double speed = 0;            ///< [m/s]
  double direction = 0;        ///< where it blows to, counter-clockwise from east [rad]
  double height = 1;           ///< of the anemometer over the ground [m]
  double air_density = 1.225;  ///< [kg/m^3]
  double time = 0;             ///< [s]
  /// Where it stands; without a place it stands in the surroundings, where no relief bends the wind.
  std::optional<MapPoint> place = std::nullopt;
};

/// The wind at the surface. A wind that is the same everywhere is two numbers; one that is not adds the
/// layers `friction_velocity` [m/s] and `direction` [rad] of a map, and `separated`: one in the air behind a
/// steep lee, in which sand comes to rest.
struct WindField {
  double friction_velocity = 0;  ///< of the flat surroundings [m/s]
  double direction = 0;          ///< where it blows to, counter-clockwise from east [rad]
  double air_density = 1.225;    ///< [kg/m^3]
  HeightMap cells;               ///< without layers when the wind is the same everywhere
  std::string model;             ///< which model made it
  double age = 0;                ///< since the map was seen for which the model was solved [s]
};

/// From a wind measured at one place to the wind at every cell.
class WindModel {
 public:
  virtual ~WindModel() = default;
  /// `surface` may be null when no map is known yet. Throws Error for an input that is not physical.
  virtual WindField solve(const WindInput& input, const HeightMap* surface) = 0;
};

/// The law of the wall over flat ground: the same wind everywhere.
class LogLawWind : public WindModel {
 public:
  /// `roughness` z0 [m], positive; throws Error otherwise.
  explicit LogLawWind(double roughness);
  WindField solve(const WindInput& input, const HeightMap* surface) override;

 private:
  double roughness_;
};

}  // namespace aeolian
