#pragma once

#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The relief that the wind feels: without holes, without what is too short. Ripples are roughness, and noise
/// of measuring is nothing, to a wind over hills and dunes.
struct WindRelief {
  GridGeometry geometry;
  std::vector<double> height;  ///< over the map's mean [m], row by row
  double mean = 0;             ///< [m]
  bool periodic = false;       ///< the map repeats; otherwise the ground goes on beyond its border
};

/// Fills what is unknown smoothly from its surroundings, then keeps half of a wave of `shortest` [m], less of
/// shorter and more of longer ones (a Gaussian); never less than four cells. Throws Error without any known
/// elevation.
WindRelief wind_relief(const HeightMap& surface, double shortest, bool periodic = false);

/// What wind_relief() does to heights without holes: a Gaussian of standard deviation `sigma` [cells].
void smooth(std::vector<double>& height, int nx, int ny, double sigma, bool periodic);

/// Slopes (rise over run) along x and y of a cell, from its neighbours.
struct Slope {
  double x;
  double y;
};
Slope slope_at(const WindRelief& relief, int x, int y);

/// The slope that only one in a thousand cells exceeds: a single spike is not steep relief.
double steepness(const WindRelief& relief);

}  // namespace aeolian
