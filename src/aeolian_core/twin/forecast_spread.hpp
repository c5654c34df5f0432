#pragma once

#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/twin/forecast.hpp"

namespace aeolian {

/// What comes over open borders from upwind is not known: within a reach downwind of them a forecast is as
/// wrong as its changes are large. Over days of wind on a bed of single grains, errors beyond those of
/// elsewhere had 0.7 times the RMS change at the border and fell off as a Gaussian over two hops and the way
/// of ripples that grow fastest.
struct BorderError {
  double direction = 0;  ///< where the wind blows to [rad]
  double reach = 0;      ///< downwind [m]
  double error = 0;      ///< standard deviation at the border [m]

  /// At a point of a grid [m].
  double at(const GridGeometry& geometry, double x, double y) const;
};

/// Of a forecast under a forcing, with ripples of the given growth. None where nothing moves.
BorderError border_error(const Forecast& forecast, const Forcing& forcing, double hop_shortening,
                         double slope_effect);

/// The standard deviation [m] of a prediction on the grid of `start`: of the members' elevations about their
/// mean, of the model's own error `model_error` [m], and of what comes over the borders. Members are on a
/// grid of their own, interpolated between its cells. Unknown where the elevation of the start is.
HeightMap::Layer spread_of(const std::vector<const HeightMap::Layer*>& members, const GridGeometry& geometry,
                           double model_error, const BorderError& border, const HeightMap& start);

}  // namespace aeolian
