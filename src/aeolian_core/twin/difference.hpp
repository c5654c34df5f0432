#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

namespace layer {
inline const std::string difference = "difference";  ///< of two elevations [m]
/// The level of detection: noise alone makes 5 % of the cells of a bed that did not change differ by more
/// [m].
inline const std::string lod95 = "lod95";
}  // namespace layer

/// How one elevation differs from another over the cells known in both. NaN when there is none.
struct DifferenceStatistics {
  std::size_t cells = 0;
  double bias = 0;  ///< mean of a - b [m]
  double rmse = 0;  ///< [m]
  double nmad = 0;  ///< 1.4826 median(|d - median(d)|) (Hoehle & Hoehle 2009) [m]
};

/// Statistics of a layer of differences; those that are not finite are left out.
DifferenceStatistics difference_statistics(const HeightMap::Layer& difference);
/// Statistics of `a - b`; throws Error when the layers differ in size.
DifferenceStatistics difference_statistics(const HeightMap::Layer& a, const HeightMap::Layer& b);

/// `a - b`, unknown where one of them is not finite; throws Error when the layers differ in size.
HeightMap::Layer difference(const HeightMap::Layer& a, const HeightMap::Layer& b);

/// 1.96 sqrt(variance of a + variance of b), where the change of a cell counts as significant beyond
/// (Brasington, Langham & Rumsby 2003, Geomorphology 53, 299-316; Lane, Westaway & Hicks 2003, Earth Surf.
/// Process. Landforms 28, 249-271). Throws Error when the layers differ in size.
HeightMap::Layer level_of_detection(const HeightMap::Layer& variance_a, const HeightMap::Layer& variance_b);

/// `a - b` as layer `difference`, with layer `lod95` from their variances. A map without variances counts as
/// exact (a prediction that states none); without any there is no lod95. The grid is that of `a`; throws
/// Error when `b` has other numbers of cells or one of them lacks an elevation. `reused`: a map of
/// differences that is no longer needed, whose memory serves for the new one.
HeightMap difference_map(const HeightMap& a, const HeightMap& b, HeightMap reused = {});

/// What moved beyond doubt: the cells whose |difference| exceeds a known lod95. The uncertainties of the
/// volumes are those of independent errors of the cells (Lane et al. 2003); a shift of a whole map comes on
/// top.
struct SignificantChange {
  std::size_t cells = 0;
  double area = 0;              ///< [m^2]
  double deposition = 0;        ///< volume gained [m^3]
  double erosion = 0;           ///< volume lost, positive [m^3]
  double deposition_sigma = 0;  ///< standard deviation [m^3]
  double erosion_sigma = 0;     ///< [m^3]
};

/// From a map with layers `difference` and `lod95`, else Error.
SignificantChange significant_change(const HeightMap& difference);

}  // namespace aeolian
