#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/bedforms/sorting/active_layer.hpp"

namespace aeolian {

/// Avalanches whose sand has the composition of the active layer that slides: the same slopes come to rest in
/// the same order, cell by cell, since only few are too steep.
class SortedAvalanches {
 public:
  SortedAvalanches(const WindFrame& frame, double cell, double tan_repose);

  /// Relaxes a bed, pads filled before and after, and its layer. Returns the volume moved, counted at each
  /// exchange [m^3].
  double run(FrameField& height, ActiveLayer& layer);

 private:
  int next(int station) const;
  std::uint8_t& disturbed(int station, int patch) {
    return disturbed_[static_cast<std::size_t>(station) * static_cast<std::size_t>(patches_) +
                      static_cast<std::size_t>(patch)];
  }
  bool steep(const FrameField& height, int station, int patch) const;
  double relax(FrameField& height, ActiveLayer& layer, int station, int patch);
  double relax_strip(FrameField& height, ActiveLayer& layer, int begin, int end);
  void disturb(int station, int patch, int begin, int end);

  int stations_, rows_, patches_;
  double area_;
  double straight_;  ///< difference of height of neighbours at repose
  bool periodic_;
  std::vector<std::uint8_t> disturbed_;  ///< patches to look at, station by station
};

}  // namespace aeolian
