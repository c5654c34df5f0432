#include "aeolian_core/twin/difference.hpp"

#include <cmath>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {
namespace {

constexpr double mad_to_sigma = 1.4826;  // of a normal distribution

void require_same_size(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  if (a.size() != b.size())
    throw Error("difference: the surfaces have " + std::to_string(a.size()) + " and " +
                std::to_string(b.size()) + " cells, must be of the same grid");
}

}  // namespace

DifferenceStatistics difference_statistics(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  require_same_size(a, b);
  const auto difference_at = [&](std::size_t i) {
    const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    return std::isfinite(d) ? d : NAN;
  };
  DifferenceStatistics result;
  double sum = 0;
  double sum_of_squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = difference_at(i);
    const bool known = !std::isnan(d);
    const double counted = known ? d : 0;
    result.cells += known ? 1 : 0;
    sum += counted;
    sum_of_squares += counted * counted;
  }
  const auto count = static_cast<double>(result.cells);
  result.bias = sum / count;
  result.rmse = std::sqrt(sum_of_squares / count);
  const double middle = quantile_of(a.size(), result.cells, 0.5, difference_at);
  result.nmad = mad_to_sigma * quantile_of(a.size(), result.cells, 0.5, [&](std::size_t i) {
                  return std::abs(difference_at(i) - middle);
                });
  return result;
}

HeightMap::Layer difference(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  require_same_size(a, b);
  HeightMap::Layer result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

}  // namespace aeolian
