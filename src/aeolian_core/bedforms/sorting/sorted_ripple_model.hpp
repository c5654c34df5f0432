#pragma once

#include <optional>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/sorting/sorted_bed.hpp"
#include "aeolian_core/bedforms/sorting/sorted_forcing.hpp"

namespace aeolian {

struct SortedRippleParameters {
  RippleParameters ripples;         ///< without wavelength law, noise or inflow of ripples
  double coarse_diameter = 0.0006;  ///< [m]
  double coarse_fraction = 0.2;     ///< of the volume of sand that the wind has not sorted
  double active_layer = 2;          ///< thickness of the layer that impacts keep mixed, in coarse diameters
  double stratum = 1;               ///< thickness of buried strata, in coarse diameters
  int strata = 16;                  ///< that are remembered one by one

  BedLayers layers() const;
};

/// Book-keeping of either size in one advance.
struct SortedChange {
  TileMask active;
  VolumeBalance fine;
  VolumeBalance coarse;
};

/// RippleModel for sand of two sizes: each is struck by the share of the surface that it takes, moves at its
/// own rate and hops its own length; what slopes and avalanches move has the composition of the active layer.
/// With the height h, the active layer's thickness L and coarse fraction f, for each size k
///
///     L df_k/dt = D_k - K_k f_k E - div(f_k q) - f_I dh/dt,   dh/dt = sum_k (D_k - K_k f_k E) - div q,
///
/// where D_k are grains of hops a_k that come down, q the slope flux and f_I the fraction of the layer where
/// the bed rises, of the stratum below where it falls (Hirano 1971). What is too steep at the beginning
/// slides first. One size alone, or two alike, behave as RippleModel. Sand has no hard ground here: a map
/// with a layer `ground` is refused. Unknown cells are taken for sand that lies between their neighbours.
///
/// Linear theory while the composition stays as it is: each size's growth rate and phase speed (RippleModel)
/// weighted with its fraction; see sorted_growth.hpp for the layer's own part.
class SortedRippleModel : public BedModel {
 public:
  /// Throws Error naming a parameter outside its range, or one of RippleModel's that two sizes lack.
  explicit SortedRippleModel(const SortedRippleParameters& parameters);

  /// `forcing` is that of the fine grains; sorted_forcing() tells that of the coarse ones. Reads and writes
  /// the layers of SortedBed and moves the layer `roughness` on. A map that is as this model left it goes on
  /// from the model's own bed in double, so that nothing of either size is lost over many calls; any other is
  /// read anew. Throws Error for a map with hard ground, or grains above the coarse diameter.
  BedChange advance(HeightMap& map, const Forcing& forcing, double duration) override;

  SortedChange advance(SortedBed& bed, const SortedForcing& forcing, double duration) const;

  /// The bed of the last map, none before the first.
  const std::optional<SortedBed>& bed() const { return bed_; }

 private:
  bool is_as_left(const HeightMap& map) const;

  SortedRippleParameters parameters_;
  std::optional<SortedBed> bed_;
  HeightMap::Layer left_height_, left_fraction_;  ///< of the last map
};

}  // namespace aeolian
