#pragma once

#include <cmath>
#include <cstddef>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {

/// What avalanches of one size of grains and of two have in common: which slopes slide, and how far.

/// Slopes are let alone until they exceed repose by this share, and come to rest as much below it.
constexpr double repose_slack = 0.01;

const double diagonal = std::sqrt(2.0);  ///< distance of cells that touch at a corner, in cells

/// What two cells exchange whose difference of height is given, so that they come to rest: a share of what is
/// beyond. `straight`: their difference at repose.
AEOLIAN_INLINE double slide(double difference, double straight, double share) {
  const double begin = straight * (1 + repose_slack);
  const double rest = straight * (1 - repose_slack);
  const double down = difference > begin ? difference - rest : 0;
  const double up = difference < -begin ? difference + rest : 0;
  return share * (down + up);
}

/// Whether any slope among two stations' rows 0 ... count is too steep; `ahead` of these rows have one more.
/// `straight`: difference of height of neighbours at repose.
bool any_steep(std::ptrdiff_t count, std::ptrdiff_t ahead, double straight, const double* height,
               const double* behind);

}  // namespace aeolian
