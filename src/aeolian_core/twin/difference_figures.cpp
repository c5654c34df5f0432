#include "aeolian_core/twin/difference_figures.hpp"

#include <array>
#include <cmath>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/twin/block_sums.hpp"
#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {
namespace {

/// Half the width, as a share of a quantile, within which the density there is counted.
constexpr double density_reach = 0.1;

/// Standard error of a quantile of sizes: that of the share below it over the density there.
double quantile_sigma(double quantile, double variance_of_share, double share_near) {
  if (quantile == 0) return 0;
  return std::sqrt(variance_of_share) * 2 * density_reach * quantile / share_near;
}

}  // namespace

DifferenceFigures difference_figures(const GridGeometry& geometry, const HeightMap::Layer& difference) {
  DifferenceFigures result;
  result.cells = count_known(difference);
  const double centre = quantile_of(difference, result.cells, 0.5);
  const double middle = quantile_of_distances(difference, result.cells, 0.5, centre);
  const double wide = quantile_of_distances(difference, result.cells, 0.9, 0);
  enum : std::size_t { value, square, within_middle, near_middle, within_wide, near_wide, quantities };
  const auto one_if = [](bool is) { return is ? 1.0 : 0.0; };
  const auto sums = block_sums<quantities>(geometry, difference, [&](double d) {
    const double off_centre = std::abs(d - centre);
    const double size = std::abs(d);
    return std::array<double, quantities>{d,
                                          d * d,
                                          one_if(off_centre <= middle),
                                          one_if(std::abs(off_centre - middle) <= density_reach * middle),
                                          one_if(size <= wide),
                                          one_if(std::abs(size - wide) <= density_reach * wide)};
  });
  result.bias = {sums.mean(value), std::sqrt(sums.variance_of_mean(value))};
  const double rmse = std::sqrt(sums.mean(square));
  result.rmse = {rmse, rmse == 0 ? 0 : std::sqrt(sums.variance_of_mean(square)) / (2 * rmse)};
  result.nmad = {sigma_per_median * middle,
                 sigma_per_median *
                     quantile_sigma(middle, sums.variance_of_mean(within_middle), sums.mean(near_middle))};
  result.le90 = {wide, quantile_sigma(wide, sums.variance_of_mean(within_wide), sums.mean(near_wide))};
  return result;
}

double correlation_area(const GridGeometry& geometry, const HeightMap::Layer& errors) {
  const auto sums = block_sums<2>(geometry, errors, [](double d) { return std::array<double, 2>{d, d * d}; });
  constexpr double fewest = 100;
  if (sums.cells() < fewest) return NAN;
  const double variance = sums.mean(1) - sums.mean(0) * sums.mean(0);
  return variance > 0 ? sums.correlation_area(0, variance) : 1;
}

}  // namespace aeolian
