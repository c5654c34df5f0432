#pragma once

#include <vector>

#include "aeolian_core/surface/grid_geometry.hpp"

namespace aeolian {

/// The dune-scale surface under ripples: the heights smoothed over `scale` [m] (three box means, which is
/// nearly a Gaussian of standard deviation scale / 2), or the plane of best fit where the grid is shorter
/// than two scales. A periodic grid keeps no plane: there it is the mean.
std::vector<double> dune_surface(const GridGeometry& geometry, const std::vector<double>& height,
                                 double scale, bool periodic);

}  // namespace aeolian
