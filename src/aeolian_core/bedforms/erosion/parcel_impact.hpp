#pragma once

#include "aeolian_core/bedforms/erosion/bounce.hpp"
#include "aeolian_core/bedforms/erosion/surface_patch.hpp"
#include "aeolian_core/bedforms/erosion/transfers.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// Impacts of parcels on a bed that stays as it is meanwhile.
class ParcelImpacts {
 public:
  /// All of it must outlive this.
  ParcelImpacts(const ErosionParameters& parameters, const Grain& grain, const ErodibleBed& bed);

  /// An impact at a place [cells]. Gives `velocity` that of the rebound and writes down what it pushes. False
  /// if the bed keeps the parcel. Random numbers depend on the parcel's name and its hop.
  bool rebounds(float x, float y, std::uint64_t name, std::uint32_t hop, Eigen::Vector3f& velocity,
                Transfers& transfers) const;

 private:
  void push(float x, float y, const Eigen::Vector2f& slope, float grains, const Eigen::Vector3f& velocity,
            float drawn, Transfers& transfers) const;

  const Bounce& bounce_;
  bool stirs_;  ///< whether what it breaks loose counts: bonds of snow
  const ErodibleBed& bed_;
  Philox random_;
  float unit_;       ///< sqrt(g d) [m/s]
  float reptation_;  ///< mean length [cells]
};

}  // namespace aeolian
