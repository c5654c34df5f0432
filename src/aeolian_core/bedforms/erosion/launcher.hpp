#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/bedforms/erosion/drift.hpp"
#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"
#include "aeolian_core/bedforms/erosion/snow_cover.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// A parcel that leaves the bed.
struct Launch {
  std::size_t cell;
  float x, y;  ///< in cells from the centre of cell (0, 0)
  Eigen::Vector3f velocity;
};

/// Where and how parcels leave: attempts at random places, which succeed where the wind lifts.
class Launcher {
 public:
  /// All of it must outlive this; `snow` may be null.
  Launcher(const ErosionParameters& parameters, const Grain& grain, const ErodibleBed& bed,
           const Drift& drift, const SnowCover* snow);

  /// Whether anything comes down on the bed, which lowers its threshold; nothing at the beginning.
  void set_impacts(bool any) { impacts_ = any; }
  /// Finds the tiles in which anything can lift; attempts go there only.
  void find_awake();
  bool anything_awake() const { return !awake_.empty(); }
  const std::vector<int>& awake() const { return awake_; }

  /// Exposure that counts at most, in that of the flat: so many attempts there succeed once.
  double most_exposed() const { return static_cast<double>(most_exposed_); }
  /// So many in all of the awake tiles [1/s], for the flux to be saturated.
  double attempts() const;
  /// What one attempt does; a pure function of its number, the seed, the bed and the wind.
  std::optional<Launch> attempt(std::uint64_t number) const;

  /// The part of the attempts at a cell that succeed, 0 to 1.
  float chance(CellIndex cell) const;
  /// Velocity of the numbered lift-off at a cell [m/s].
  Eigen::Vector3f lift_off(std::uint64_t number, std::size_t cell) const;

 private:
  bool in_shadow(CellIndex cell, const Drift::Cell& wind) const;
  bool at_edge(CellIndex cell, const Drift::Cell& wind) const;
  float friction_threshold(std::size_t cell, float slope_along) const;
  bool anything_lifts_in(const CellRange& range) const;

  const ErosionParameters& p_;
  const Grain& grain_;
  const ErodibleBed& bed_;
  const Drift& drift_;
  const SnowCover* snow_;
  Philox random_;
  float fall_;             ///< of a ray over a cell [m]
  float weight_, sticks_;  ///< terms of the threshold's square, of gravity and of cohesion [m^2/s^2]
  float tan_repose_;
  float most_exposed_;  ///< exposure that counts, in that of the flat
  bool impacts_ = false;
  std::vector<int> awake_;
};

}  // namespace aeolian
