#pragma once

#include <vector>

#include "aeolian_core/bedforms/sorting/strata.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// How a bed of two sizes is described.
struct BedLayers {
  double active = 0.001;    ///< thickness of the well-mixed layer at the surface that impacts reach [m]
  double stratum = 0.0005;  ///< thickness of a stratum [m]
  int remembered = 16;      ///< strata that are remembered one by one, 1 to 64
  double bulk = 0.2;  ///< volume fraction of coarse grains in sand that the wind has not touched, 0 to 1
};

/// Throws Error naming what is outside its range.
void check(const BedLayers& layers);

/// A bed of fine and coarse grains, cell by cell in double: its height, the coarse sand in the active layer,
/// in the stratum that is being laid under it, and in strata below. Strata end at multiples of their
/// thickness, so that heights tell how thick the uppermost is.
///
/// On a map the active layer is the layer `coarse_fraction`, and what lies below `coarse_fraction_1` ... from
/// above, the first of them as thick as it has grown; older deposits are not on the map.
struct SortedBed {
  GridGeometry geometry;
  BedLayers layers;
  std::vector<double> height;        ///< [m]
  std::vector<double> coarse;        ///< in the active layer [m]
  std::vector<double> upper;         ///< thickness of the stratum under it [m], above zero
  std::vector<double> upper_coarse;  ///< [m]
  Strata strata;

  /// A bed of the bulk's composition throughout. Throws Error for heights that are too few or not finite.
  SortedBed(const GridGeometry& geometry, std::vector<double> height, const BedLayers& layers);
  /// The bed of a map, cells with unknown height filled from around; composition that the map does not tell
  /// is the bulk's. Throws Error naming a fraction outside 0 to 1.
  SortedBed(const HeightMap& map, const BedLayers& layers);

  /// Volume above height zero, below which lies the bulk [m^3].
  double volume() const;
  double coarse_volume() const;

  /// Volume fraction of coarse grains in the active layer of a cell.
  double surface_fraction(std::size_t cell) const { return coarse[cell] / layers.active; }
  /// The same at a depth below the surface [m].
  double fraction_at(std::size_t cell, double depth) const;

  /// Writes composition into the layers of a map, NaN where its elevation is.
  void write_composition(HeightMap& map) const;
};

}  // namespace aeolian
