#pragma once

#include <string>
#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"

namespace aeolian {

/// Throws Error, beginning with the model's name, for a map whose elevation is missing or unknown somewhere,
/// or that has a layer `ground`: models of grains know neither holes nor hard floors.
void check_all_sand(const std::string& model, const HeightMap& map);

/// The elevation of a map as a model of grains last left it, in double: what the map's floats or the model's
/// grains are too coarse for is kept from one call to the next.
class KeptSurface {
 public:
  /// Makes this the elevation of a map. False if it was, bit for bit, what `store` left there.
  bool take(const HeightMap& map);
  const std::vector<double>& height() const { return height_; }  ///< of the cells [m]

  /// Adds the change of each cell [m] and writes the map. `moved`: sand set moving [m^3].
  BedChange store(const std::vector<double>& change, double moved, HeightMap& map);

 private:
  GridGeometry geometry_;
  std::vector<double> height_;
  HeightMap::Layer stored_;
  /// What rounding has taken from the floats, summed over the cells: the next cell that changes gets it.
  double owed_ = 0;
};

}  // namespace aeolian
