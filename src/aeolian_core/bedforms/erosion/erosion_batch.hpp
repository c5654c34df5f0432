#pragma once

#include "aeolian_core/bedforms/erosion/erosion_run.hpp"

namespace aeolian {

/// What a batch of parcels did, in their order.
struct ErosionRun::Batch {
  Transfers transfers;
  std::vector<std::size_t> ended;  ///< parcels that are no longer in the air
  std::int64_t hops = 0;
  double way = 0;  ///< of all, along the wind [m]

  void clear() {
    transfers.clear();
    ended.clear();
    hops = 0;
    way = 0;
  }
};

}  // namespace aeolian
