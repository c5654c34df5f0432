#pragma once

#include "aeolian_core/bedforms/height_map/wind_frame.hpp"
#include "aeolian_core/bedforms/sorting/sorted_bed.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {

/// The part of a layer that is coarse, 0 to 1.
AEOLIAN_INLINE double coarse_part(double coarse, double thickness) {
  const double part = coarse / thickness;
  const double positive = part > 0 ? part : 0;
  return positive < 1 ? positive : 1;
}

/// The active layer of a bed in a wind frame: all that moves comes from it and comes to rest in it, well
/// mixed. While sand moves its thickness changes with the bed's height; settle() then gives what is too much
/// to the stratum below, in the layer's composition, or takes what is missing from there (Hirano 1971).
class ActiveLayer {
 public:
  /// The bed outlives this.
  ActiveLayer(const WindFrame& frame, SortedBed& bed);

  FrameField& thickness() { return thickness_; }  ///< [m]
  FrameField& coarse() { return coarse_; }        ///< [m]
  FrameField& fraction() { return fraction_; }    ///< of coarse grains, 0 to 1, pads filled; see mix()
  const FrameField& fraction() const { return fraction_; }

  /// Makes the fraction at a station what thickness and coarse sand say.
  void mix(int station);
  /// Takes strata into the layer of a cell until it is so thick [m].
  void dig(int station, int row, double least);
  /// Has a cell give so much [m] to another, in its layer's composition.
  void give(int station, int row, int to_station, int to_row, double amount);
  /// Makes all layers as thick as they should be, and mixes them.
  void settle();
  /// The largest fraction among all cells at the last settling.
  double coarsest() const { return coarsest_; }

  /// Writes what has changed back into the bed, but for its height.
  void leave();

 private:
  std::size_t cell(int station, int row) const { return static_cast<std::size_t>(cell_.at(station)[row]); }
  void open_stratum(int station, int row);
  void settle_cell(int station, int row);

  const WindFrame& frame_;
  SortedBed& bed_;
  double nominal_;
  double stratum_;
  double coarsest_ = 0;
  FrameField thickness_, coarse_, fraction_;
  FrameField upper_, upper_coarse_;  ///< the stratum below
  FrameField cell_;                  ///< index in the bed's grid
};

}  // namespace aeolian
