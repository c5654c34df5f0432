#pragma once

#include <vector>

#include "aeolian_core/slide/mpm/obstacle.hpp"

namespace aeolian {

/// How a pile is measured, simulated or scanned (Frischholz, section 3.4 of the specification).
struct PileRules {
  double ground_tilt = 0;  ///< of the plane that the points stand on, about y [rad]
  double link = 0.02;      ///< snow within such cells that touch is one body [m]
  double trimmed = 0.03;   ///< share of the points that are outliers
  int cells = 30;          ///< of the shell, along each side of the box about the pile
};

/// A pile's size. Lengths are along x, the slide's direction.
struct PileSize {
  double height = 0;       ///< of the highest point above the ground [m]
  double length = 0;       ///< from head to tail [m]
  double head = 0;         ///< x of the end nearest to the panel [m]
  double tail = 0;         ///< x of the far end [m]
  double raw_length = 0;   ///< of the main body before outliers were taken off [m]
  std::size_t points = 0;  ///< of the main body
  double shape() const { return height / length; }
};

/// Measures the pile among equal parts of snow, heights above the ground: turns the ground level, keeps the
/// largest body that hangs together, takes off the outliers (three dimensions: those farthest from the
/// vertical through the centre; two: both ends step inwards), keeps the highest point of each cell, and takes
/// height and length of that shell. Throws Error when there are no points or not all are finite.
template <int Dim>
PileSize measure_pile(const std::vector<Point<Dim>>& points, const PileRules& rules = {});

/// Points of a map's snow, equally many per volume, for measure_pile: one for each cube of the cell's size in
/// the depth over `ground`, of which layer `elevation` is the top. Cells without either are left out.
std::vector<Point<3>> points_of_map(const HeightMap& map);

extern template PileSize measure_pile(const std::vector<Point<2>>&, const PileRules&);
extern template PileSize measure_pile(const std::vector<Point<3>>&, const PileRules&);

}  // namespace aeolian
