#pragma once

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// How a layer of differences is spread, each figure with its standard error [m]. NaN when no cell is known.
///
/// Standard errors hold for any distribution and for neighbours that differ alike (BlockSums): that of the
/// mean from the means of blocks, that of the RMSE from the mean of squares, those of NMAD and LE90 from the
/// share of cells within them and how quickly it grows there.
struct DifferenceFigures {
  std::size_t cells = 0;
  Figure bias;  ///< mean
  Figure rmse;
  Figure nmad;  ///< 1.4826 median(|d - median(d)|) (Hoehle & Hoehle 2009, ISPRS J. 64, 398-406)
  Figure le90;  ///< 90 % of the cells differ by no more: the linear error of NSSDA, without a normal law
};

DifferenceFigures difference_figures(const GridGeometry& geometry, const HeightMap::Layer& difference);

/// How many cells of a layer err as one: the integral of their correlation over the plane, in cells, at
/// least 1. What is unknown does not count; NaN when fewer than a hundred cells are known.
double correlation_area(const GridGeometry& geometry, const HeightMap::Layer& errors);

}  // namespace aeolian
