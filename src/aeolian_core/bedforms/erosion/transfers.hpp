#pragma once

#include <cstdint>
#include <vector>

namespace aeolian {

/// Grains that change places, in cells from the centre of cell (0, 0). What a batch of parcels does is
/// written down against the bed as it was before and then carried out in order of the parcels, so the result
/// does not depend on who worked on which.
struct Transfer {
  enum class Kind : std::uint8_t {
    settled,  ///< a parcel of the air comes down for good
    lifted,   ///< a parcel leaves and comes down; if the bed has none left, neither that nor what it pushed
    pushed,   ///< as much as there is of loose grains, on the way of the last parcel
    stirred,  ///< bonds of so many grains break where it comes from
  };
  float from_x, from_y, to_x, to_y;
  std::int32_t units;
  Kind kind;
  bool outside;  ///< it ends beyond an open border
};

using Transfers = std::vector<Transfer>;

}  // namespace aeolian
