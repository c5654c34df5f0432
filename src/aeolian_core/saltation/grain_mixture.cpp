#include "aeolian_core/saltation/grain_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double widest = 100;  ///< largest over smallest diameter

}  // namespace

double GrainMixture::mean_diameter() const {
  return std::inner_product(diameter.begin(), diameter.end(), share.begin(), 0.0);
}

void check(const GrainMixture& mixture) {
  if (mixture.diameter.empty() || mixture.diameter.size() != mixture.share.size())
    throw Error("grain mixture: there are " + std::to_string(mixture.diameter.size()) + " diameters and " +
                std::to_string(mixture.share.size()) + " shares, must be equally many, one or more");
  for (std::size_t k = 0; k < mixture.share.size(); ++k) {
    const double diameter = mixture.diameter[k];
    const double share = mixture.share[k];
    if (!(diameter > 0 && std::isfinite(diameter)))
      throw Error("grain mixture: diameter " + std::to_string(k + 1) + " is " + std::to_string(diameter) +
                  " m, must be positive");
    if (!(share > 0 && share <= 1 + 1e-9))
      throw Error("grain mixture: share " + std::to_string(k + 1) + " is " + std::to_string(share) +
                  ", must be above 0 to 1");
  }
  const double sum = std::accumulate(mixture.share.begin(), mixture.share.end(), 0.0);
  if (!(std::abs(sum - 1) < 1e-6))
    throw Error("grain mixture: shares add up to " + std::to_string(sum) + ", must be 1");
  const auto ends = std::minmax_element(mixture.diameter.begin(), mixture.diameter.end());
  if (*ends.second > widest * *ends.first)
    throw Error("grain mixture: diameters are " + std::to_string(1e3 * *ends.first) + " to " +
                std::to_string(1e3 * *ends.second) + " mm, must not differ by more than 100 times");
}

GrainMixture read_mixture(const std::string& path) {
  const Table table = read_csv(path);
  try {
    GrainMixture mixture{table.column("diameter_mm"), table.column("share")};
    const double sum = std::accumulate(mixture.share.begin(), mixture.share.end(), 0.0);
    for (double& diameter : mixture.diameter) diameter *= 1e-3;
    for (std::size_t k = 0; k < mixture.share.size(); ++k) {
      if (!(mixture.share[k] > 0))
        throw Error("grain mixture: share " + std::to_string(k + 1) + " is " +
                    std::to_string(mixture.share[k]) + ", must be positive");
      mixture.share[k] /= sum;
    }
    check(mixture);
    return mixture;
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
}

}  // namespace aeolian
