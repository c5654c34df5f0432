#pragma once

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Volumes between two surfaces, with standard errors [m^3].
struct VolumeChange {
  std::size_t known_cells = 0;        ///< with a difference and a level of detection
  std::size_t significant_cells = 0;  ///< that differ by more than their level of detection
  Figure gain;                        ///< in the significant cells that rose
  Figure loss;                        ///< in those that sank, positive
  Figure net;  ///< of all known cells: a threshold would pull it towards zero (Anderson 2019)
};

/// Volumes from layers `difference` and `lod95`, else Error.
///
/// The variance of a sum over n cells is that of independent cells (Lane, Westaway & Hicks 2003, Earth Surf.
/// Process. Landforms 28, 249-271) times the number of cells that err as one, `correlation_area` >= 1, at
/// most n (Rolstad, Haug & Denby 2009, J. Glaciol. 55, 666-680), plus that of a height error
/// `common_sigma` [m] that all cells share. (Wheaton et al. 2010, ESPL 35, 136-156, weigh cells by the
/// coherence of change; here the sum of all known cells stands beside, unthresholded: Anderson 2019, ESPL 44,
/// 1015-1033.)
VolumeChange volume_change(const HeightMap& difference, double correlation_area, double common_sigma = 0);

}  // namespace aeolian
