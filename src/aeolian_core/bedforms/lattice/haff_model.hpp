#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/lattice/haff_bed.hpp"
#include "aeolian_core/bedforms/lattice/kept_surface.hpp"

namespace aeolian {

struct HaffModelParameters {
  double bin_length = 4;  ///< [effective grain diameters]; a cell holds the nearest whole number of bins
  /// No grain is taken where the bed rises downwind of it more steeply than this [rad].
  std::optional<double> steepest_stoss;
};

/// Haff's bed as a model of a periodic map that is sand all through, for winds along an axis of its grid.
/// Every row of cells along the wind is a slice of its own, one grain thick, that stands for the whole row.
/// The model begins with grains in the shape of the map and goes on with them for as long as the map is what
/// it left there and the wind blows the same way. What they do is added to the map.
class HaffModel : public BedModel {
 public:
  /// Throws Error naming the parameter that is not allowed.
  HaffModel(const HaffModelParameters& parameters, std::uint64_t seed);
  /// Throws Error as well for a map with unknown cells or a layer `ground`, for a wind that is not along an
  /// axis, for hops of less than half a bin, and for what HaffBed refuses.
  BedChange advance(HeightMap& map, const Forcing& forcing, double duration) override;

 private:
  /// How the map is cut into slices.
  struct Slices {
    int quarter;  ///< turns of 90 degrees from east to the wind
    int rows, cells, bins_per_cell;
    double bin;    ///< length [m]
    double layer;  ///< by which a grain raises a bin [m]

    int bins() const { return cells * bins_per_cell; }
    std::size_t cell(const GridGeometry& geometry, int row, int along) const;
    bool operator==(const Slices& other) const;
  };

  Slices cut(const GridGeometry& geometry, const Forcing& forcing) const;
  std::vector<std::vector<int>> fill(const GridGeometry& geometry) const;
  std::optional<HaffParameters> bed_of(const Slices& slices, const Forcing& forcing) const;

  HaffModelParameters parameters_;
  std::uint64_t seed_;
  std::uint64_t streams_ = 0;  ///< of random numbers used up
  KeptSurface surface_;
  Slices slices_{};
  std::vector<std::vector<int>> grains_;  ///< of each bin of each slice, downwind
};

}  // namespace aeolian
