#include "aeolian_core/bedforms/height_map/exposure.hpp"

#include <algorithm>
#include <limits>

namespace aeolian {
namespace {

/// Turns heights into exposure, given the envelope M just upwind of the first cell; x counts from the first
/// cell.
void sweep(const double* height, std::size_t count, double drop, double envelope, double* exposure) {
  const double per_drop = 1 / drop;
  for (std::size_t i = 0; i < count; ++i) {
    const double here = std::max(envelope, height[i] + static_cast<double>(i) * drop);
    exposure[i] = (here - envelope) * per_drop;
    envelope = here;
  }
}

/// The envelope M of a row, as it is met at the first cell of the row that follows downwind, with x counted
/// from there.
double envelope_after(const double* height, std::size_t count, double drop) {
  double envelope = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i)
    envelope = std::max(envelope, height[i] + static_cast<double>(i) * drop);
  return envelope - static_cast<double>(count) * drop;
}

}  // namespace

void exposure_periodic(const double* height, std::size_t count, double drop, double* exposure) {
  sweep(height, count, drop, envelope_after(height, count, drop), exposure);
}

void exposure_open(const double* height, std::size_t count, double drop, double inflow_height,
                   double* exposure) {
  sweep(height, count, drop, inflow_height - drop, exposure);
}

}  // namespace aeolian
