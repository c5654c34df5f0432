#pragma once

#include <string>
#include <vector>

namespace aeolian {

/// A bed of grains of several sizes and one density.
struct GrainMixture {
  std::vector<double> diameter;  ///< [m]
  std::vector<double> share;  ///< of the bed that each size takes (f_k of Kok & Renno 2009); their sum is one

  double mean_diameter() const;  ///< by share [m]
};

/// Throws Error naming what is empty, not positive or does not add up to one, and diameters that differ by
/// more than a hundred times.
void check(const GrainMixture& mixture);

/// Columns diameter_mm and share; shares are taken relative to their sum. Throws Error naming the file and
/// what is wrong with it.
GrainMixture read_mixture(const std::string& path);

}  // namespace aeolian
