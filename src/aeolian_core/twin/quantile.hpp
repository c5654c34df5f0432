#pragma once

#include <vector>

namespace aeolian {

/// The value below which a share of the sample lies, linear between order statistics (0 least, 0.5 median, 1
/// greatest). The sample is reordered. NaN when it is empty; it must hold no NaN.
double quantile(std::vector<double>& sample, double share);

}  // namespace aeolian
