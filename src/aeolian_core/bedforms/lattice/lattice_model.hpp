#pragma once

#include <cstdint>
#include <optional>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/lattice/kept_surface.hpp"
#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"

namespace aeolian {

struct LatticeParameters {
  /// Distance of columns, at most [m]. A cell holds a whole number of them along each edge, an even one if
  /// the map has an odd number of cells along either axis.
  double spacing = 0.0008;
};

/// The lattice bed of single grains as a model of a periodic map that is sand all through. It begins with
/// grains in the shape of the map and goes on with them for as long as the map is what it left there; after
/// a change from outside it begins anew. What the grains do is added to the map: detail finer than a grain,
/// and faces steeper than repose, stay as they are.
class LatticeModel : public BedModel {
 public:
  /// Throws Error naming the parameter that is not allowed.
  LatticeModel(const LatticeParameters& parameters, std::uint64_t seed);
  /// Throws Error as well for a map with unknown cells or a layer `ground`.
  BedChange advance(HeightMap& map, const Forcing& forcing, double duration) override;

 private:
  void begin(const GridGeometry& geometry, double angle_of_repose);
  std::vector<int> sums(const GridGeometry& geometry) const;

  LatticeParameters parameters_;
  std::uint64_t seed_;
  std::uint64_t begun_ = 0;  ///< beds
  int columns_per_cell_ = 0;
  double angle_of_repose_ = 0;
  KeptSurface surface_;
  std::optional<LatticeBed> bed_;
};

}  // namespace aeolian
