#pragma once

#include <cstddef>
#include <vector>

namespace aeolian {

/// The value below which a share of the sample lies, linear between order statistics (0 least, 0.5 median, 1
/// greatest). The sample is reordered. NaN when it is empty; it must hold no NaN.
double quantile(std::vector<double>& sample, double share);

/// quantile() of the values that are not NaN, of which there are `known`, to the bit: a probe tells between
/// which values the quantile most likely lies, one pass counts what is below and keeps the few between.
double quantile_of(const std::vector<float>& values, std::size_t known, double share);

/// The same of their distances from a centre.
double quantile_of_distances(const std::vector<float>& values, std::size_t known, double share,
                             double centre);

}  // namespace aeolian
