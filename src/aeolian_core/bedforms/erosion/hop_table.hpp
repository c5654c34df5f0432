#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/atmosphere.hpp"

namespace aeolian {

/// One flight over flat ground, along the wind.
struct Hop {
  double range = 0;          ///< [m]
  double time = 0;           ///< [s]
  double apex = 0;           ///< height [m]
  double apex_distance = 0;  ///< [m]
  double along = 0;          ///< velocity of impact [m/s]
  double down = 0;
  double lateral_time = 0;  ///< way across the wind over the velocity across it at the beginning [s]
  double lateral_kept = 0;  ///< part of that velocity at the end
};

/// A wind that is the same everywhere over flat ground, and the grains in it.
struct HopWind {
  double friction_velocity = 0;  ///< [m/s]
  double roughness = 0;          ///< z0 [m]
  Grain grain;
  Atmosphere air;
};

/// The flight of a grain that leaves the ground with these velocities along the wind and up [m/s], integrated
/// with steps of `step` [s]; the last one ends on the ground (specification sec. 2.4). Not up: no hop at all.
Hop flown_hop(const HopWind& wind, double along, double up, double step = 1e-4);

/// Hops of one wind, tabulated over the velocities of lift-off, linear in their square roots' squares.
class HopTable {
 public:
  /// For velocities along the wind from zero to `fastest` and up to `highest` [m/s], both positive; outside,
  /// the nearest serve. `nodes`: in each direction, two or more.
  HopTable(const HopWind& wind, double fastest, double highest, int nodes = 40);

  Hop at(float along, float up) const;
  const HopWind& wind() const { return wind_; }

 private:
  static constexpr std::size_t values = 8;
  using Node = std::array<float, values>;

  HopWind wind_;
  int nodes_;
  float along_scale_, up_scale_;
  std::vector<Node> table_;
};

}  // namespace aeolian
