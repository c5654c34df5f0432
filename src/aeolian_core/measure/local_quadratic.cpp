#include "aeolian_core/measure/local_quadratic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

/// One pass with given robust weights.
void pass(const std::vector<double>& x, const std::vector<double>& y, double half_width,
          LocalQuadratic& result) {
  const std::size_t n = x.size();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::size_t begin = 0;
  std::size_t end = 0;
  std::vector<double> weights;
  for (std::size_t k = 0; k < n; ++k) {
    while (x[begin] <= x[k] - half_width) ++begin;
    while (end < n && x[end] < x[k] + half_width) ++end;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    weights.assign(end - begin, 0);
    int used = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double t = (x[i] - x[k]) / half_width;
      const double tricube = std::pow(1 - std::abs(t * t * t), 3);
      const double weight = std::isnan(y[i]) ? 0 : tricube * result.robust_weight[i];
      if (weight > 0) ++used;
      weights[i - begin] = weight;
      const Eigen::Vector3d row(1, t, t * t);
      normal += weight * row * row.transpose();
      if (weight > 0) right += weight * y[i] * row;
    }
    result.fit[k] = result.slope[k] = nan;
    result.noise_gain[k] = result.leverage[k] = nan;
    if (used < 5 || std::isnan(y[k])) continue;
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    const Eigen::Vector3d coefficients = solver.solve(right);
    const Eigen::Vector3d own = solver.solve(Eigen::Vector3d::UnitX());
    double squares = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double t = (x[i] - x[k]) / half_width;
      squares += std::pow(weights[i - begin] * own.dot(Eigen::Vector3d(1, t, t * t)), 2);
    }
    result.fit[k] = coefficients[0];
    result.slope[k] = coefficients[1] / half_width;
    result.noise_gain[k] = std::sqrt(squares);
    result.leverage[k] = weights[k - begin] * own[0];
  }
}

}  // namespace

LocalQuadratic local_quadratic(const std::vector<double>& x, const std::vector<double>& y,
                               double half_width) {
  const std::size_t n = x.size();
  LocalQuadratic result;
  result.fit.resize(n);
  result.slope.resize(n);
  result.leverage.resize(n);
  result.noise_gain.resize(n);
  result.robust_weight.assign(n, 1);
  std::vector<double> misses;
  for (int round = 0; round < 3; ++round) {
    pass(x, y, half_width, result);
    if (round == 2) break;
    misses.clear();
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isnan(result.fit[i]) && !std::isnan(y[i])) misses.push_back(std::abs(y[i] - result.fit[i]));
    if (misses.empty()) break;
    const double limit = 6 * median(misses);
    for (std::size_t i = 0; i < n; ++i) {
      const double t =
          std::isnan(result.fit[i]) || std::isnan(y[i]) || limit == 0 ? 0 : (y[i] - result.fit[i]) / limit;
      result.robust_weight[i] = std::abs(t) < 1 ? std::pow(1 - t * t, 2) : 0;
    }
  }
  return result;
}

}  // namespace aeolian
