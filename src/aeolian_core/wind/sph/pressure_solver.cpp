#include "aeolian_core/wind/sph/pressure_solver.hpp"

#include <cmath>
#include <numeric>

namespace aeolian::sph {
namespace {

float weighted_sum(const NeighbourRows& rows, std::size_t i, const float* p) {
  const std::size_t end = rows.end[i];
  const float* weight = rows.weight.data();
  const std::uint32_t* who = rows.who.data();
  float a = 0, b = 0, c = 0, d = 0;
  std::size_t k = rows.begin[i];
  for (; k + 4 <= end; k += 4) {
    a += weight[k] * p[who[k]];
    b += weight[k + 1] * p[who[k + 1]];
    c += weight[k + 2] * p[who[k + 2]];
    d += weight[k + 3] * p[who[k + 3]];
  }
  for (; k < end; ++k) a += weight[k] * p[who[k]];
  return (a + b) + (c + d);
}

/// diagonal p - sum weight p; a particle's own image takes away what the diagonal has of it.
float balance(const NeighbourRows& rows, const std::vector<float>& diagonal, std::size_t i, const float* p) {
  return diagonal[i] * p[i] - weighted_sum(rows, i, p);
}

double total(const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

void remove_mean(std::vector<float>& values, std::vector<double>& sums) {
  for_chunks(values.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += static_cast<double>(values[i]);
    sums[c] = sum;
  });
  const auto mean = static_cast<float>(total(sums) / static_cast<double>(values.size()));
  for_chunks(values.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] -= mean;
  });
}

}  // namespace

float PressureSolver::solve(const NeighbourRows& rows, const std::vector<float>& diagonal,
                            const std::vector<float>& source, const Limits& limits,
                            std::vector<float>& pressure) {
  const std::size_t n = pressure.size();
  residual_.resize(n);
  direction_.assign(n, 0);
  product_.resize(n);
  sums_.resize(chunks_of(n));
  more_sums_.resize(chunks_of(n));
  iterations_ = 0;
  remove_mean(pressure, sums_);
  for_chunks(n, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      residual_[i] = -source[i] - balance(rows, diagonal, i, pressure.data());
  });
  remove_mean(residual_, sums_);
  const auto scale = [&](std::size_t i) { return diagonal[i] > 0 ? 1 / diagonal[i] : 0; };
  const auto measure = [&](double& weighted, double& plain) {
    for_chunks(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
      double sum = 0;
      double more = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const auto r = static_cast<double>(residual_[i]);
        sum += r * r * static_cast<double>(scale(i));
        more += r * r;
      }
      sums_[c] = sum;
      more_sums_[c] = more;
    });
    weighted = total(sums_);
    plain = std::sqrt(total(more_sums_) / static_cast<double>(n));
  };
  double before = 0;
  double left = 0;
  measure(before, left);
  double weight = 0;
  while (left > static_cast<double>(limits.residual) && iterations_ < limits.iterations) {
    const auto keep = static_cast<float>(weight);
    for_chunks(n, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        direction_[i] = scale(i) * residual_[i] + keep * direction_[i];
    });
    for_chunks(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t i = begin; i < end; ++i) {
        product_[i] = balance(rows, diagonal, i, direction_.data());
        sum += static_cast<double>(product_[i]) * static_cast<double>(direction_[i]);
      }
      sums_[c] = sum;
    });
    const double curvature = total(sums_);
    if (!(curvature > 0)) break;
    const auto step = static_cast<float>(before / curvature);
    for_chunks(n, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        pressure[i] += step * direction_[i];
        residual_[i] -= step * product_[i];
      }
    });
    double after = 0;
    measure(after, left);
    weight = after / before;
    before = after;
    ++iterations_;
  }
  return static_cast<float>(left);
}

}  // namespace aeolian::sph
