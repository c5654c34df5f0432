#include "aeolian_core/bedforms/lateral_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int most_taps = FrameField::pad;

/// Moments of a row's values under the taps: sums of weight times 1, distance and its square.
template <int taps>
AEOLIAN_INLINE void sum_taps(std::ptrdiff_t count, const double* weight, const double* __restrict v,
                             double* __restrict sum, double* __restrict first, double* __restrict second) {
  std::array<double, taps + 1> w{}, w1{}, w2{};
  for (int m = 0; m <= taps; ++m) {
    w[m] = weight[m];
    w1[m] = m * weight[m];
    w2[m] = m * m * weight[m];
  }
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double s = w[0] * v[i];
    double d1 = 0;
    double d2 = 0;
#pragma GCC unroll 8
    for (int m = 1; m <= taps; ++m) {
      const double both = v[i + m] + v[i - m];
      s += w[m] * both;
      d1 += w1[m] * (v[i + m] - v[i - m]);
      d2 += w2[m] * both;
    }
    sum[i] = s;
    first[i] = d1;
    second[i] = d2;
  }
}

template <int taps>
AEOLIAN_INLINE void sum_taps_straight(std::ptrdiff_t count, const double* weight, const double* __restrict v,
                                      double* __restrict sum) {
  std::array<double, taps + 1> w{};
  for (int m = 0; m <= taps; ++m) w[m] = weight[m];
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double s = w[0] * v[i];
#pragma GCC unroll 8
    for (int m = 1; m <= taps; ++m) s += w[m] * (v[i + m] + v[i - m]);
    sum[i] = s;
  }
}

AEOLIAN_KERNEL void moments(int taps, std::ptrdiff_t count, const double* weight, const double* __restrict v,
                            double* __restrict sum, double* __restrict first, double* __restrict second) {
  switch (taps) {
    case 1:
      return sum_taps<1>(count, weight, v, sum, first, second);
    case 2:
      return sum_taps<2>(count, weight, v, sum, first, second);
    case 3:
      return sum_taps<3>(count, weight, v, sum, first, second);
    case 4:
      return sum_taps<4>(count, weight, v, sum, first, second);
    case 5:
      return sum_taps<5>(count, weight, v, sum, first, second);
    case 6:
      return sum_taps<6>(count, weight, v, sum, first, second);
    case 7:
      return sum_taps<7>(count, weight, v, sum, first, second);
    default:
      return sum_taps<8>(count, weight, v, sum, first, second);
  }
}

AEOLIAN_KERNEL void mean_across(int taps, std::ptrdiff_t count, const double* weight,
                                const double* __restrict v, double* __restrict sum) {
  switch (taps) {
    case 1:
      return sum_taps_straight<1>(count, weight, v, sum);
    case 2:
      return sum_taps_straight<2>(count, weight, v, sum);
    case 3:
      return sum_taps_straight<3>(count, weight, v, sum);
    case 4:
      return sum_taps_straight<4>(count, weight, v, sum);
    case 5:
      return sum_taps_straight<5>(count, weight, v, sum);
    case 6:
      return sum_taps_straight<6>(count, weight, v, sum);
    case 7:
      return sum_taps_straight<7>(count, weight, v, sum);
    default:
      return sum_taps_straight<8>(count, weight, v, sum);
  }
}

/// The sum of the taps where some cells are closed: each pair of cells exchanges by itself.
AEOLIAN_KERNEL void exchange_across(int taps, std::ptrdiff_t count, const double* weight,
                                    const double* __restrict v, const double* __restrict open,
                                    double* __restrict sum) {
  for (std::ptrdiff_t i = 0; i < count; ++i) sum[i] = v[i];
  for (int m = 1; m <= taps; ++m)
    for (std::ptrdiff_t i = 0; i < count; ++i)
      sum[i] += weight[m] * open[i] * (open[i + m] * (v[i + m] - v[i]) + open[i - m] * (v[i - m] - v[i]));
}

AEOLIAN_KERNEL void close_faces(std::ptrdiff_t count, const double* __restrict open,
                                const double* __restrict next_open, double* __restrict flux) {
  for (std::ptrdiff_t i = 0; i < count; ++i) flux[i] *= open[i] * next_open[i];
}

/// Moves the taps m rows away by m times the drift upwind: the flux between two stations that this is, and no
/// more of it than half of what is there.
AEOLIAN_KERNEL void flux_between(std::ptrdiff_t count, double drift, const double* __restrict sum,
                                 const double* __restrict next_sum, const double* __restrict first,
                                 const double* __restrict next_first, const double* __restrict second,
                                 const double* __restrict next_second, double* __restrict flux) {
  const double along = 0.5 * drift;
  const double bend = 0.5 * drift * drift;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double raw = along * (first[i] + next_first[i]) - bend * (next_second[i] - second[i]);
    const double most = 0.5 * sum[i] > 0 ? 0.5 * sum[i] : 0;
    const double least = -0.5 * next_sum[i] < 0 ? -0.5 * next_sum[i] : 0;
    const double capped = raw < most ? raw : most;
    flux[i] = capped > least ? capped : least;
  }
}

AEOLIAN_KERNEL void settle(std::ptrdiff_t count, const double* __restrict sum, const double* __restrict in,
                           const double* __restrict out, double* __restrict result) {
  for (std::ptrdiff_t i = 0; i < count; ++i) result[i] = sum[i] + (in[i] - out[i]);
}

}  // namespace

LateralSpread::LateralSpread(const WindFrame& frame, double sigma) : frame_(frame) {
  if (frame.rows() < 2 || !(sigma > 0)) return;
  // Wider than the grid is no wider than the grid.
  const double most = frame.rows();
  const double cosine_squared = 1 / (1 + frame.drift() * frame.drift());
  const double rows = std::min(sigma * sigma * cosine_squared, most * most);
  const double stations = rows * frame.drift() * frame.drift();
  constexpr double most_in_folding = 0.6;
  // Beyond this variance along the stations the interpolation between them would amplify the shortest waves.
  constexpr double most_along = 0.4;
  passes_ =
      static_cast<int>(std::ceil(std::max(rows / (most_in_folding * most_taps), stations / most_along)));
  // The kernel of a pass is (b, 1 - 2b, b), of variance 2b, folded with itself.
  const double variance = rows / passes_;
  const int foldings = static_cast<int>(std::ceil(variance / most_in_folding));
  const double b = variance / foldings / 2;
  std::vector<double> kernel{1};
  for (int n = 0; n < foldings; ++n) {
    std::vector<double> wider(kernel.size() + 2, 0.0);
    for (std::size_t i = 0; i < kernel.size(); ++i) {
      wider[i] += b * kernel[i];
      wider[i + 1] += (1 - 2 * b) * kernel[i];
      wider[i + 2] += b * kernel[i];
    }
    kernel = wider;
  }
  weight_.assign(kernel.begin() + foldings, kernel.end());
}

void LateralSpread::pass(const FrameField& from, int begin, int count, int row_begin, int row_end,
                         const FrameField* open, FrameField& to) const {
  const int rows = row_end - row_begin;
  const int taps = static_cast<int>(weight_.size()) - 1;
  const int n = frame_.stations();
  const auto mask_of = [&](int i) { return open->at(((begin + i) % n + n) % n) + row_begin; };
  if (frame_.drift() == 0) {
    for (int i = 0; i < count; ++i) {
      const double* const values = from.at(i) + row_begin;
      mean_across(taps, rows, weight_.data(), values, to.at(i) + row_begin);
      if (open) exchange_across(taps, rows, weight_.data(), values, mask_of(i), to.at(i) + row_begin);
    }
    return;
  }
  const bool wall_before = !frame_.periodic() && begin == 0;
  const bool wall_behind = !frame_.periodic() && begin + count == n;
  struct Moments {
    std::vector<double> sum, first, second, flux;  ///< `flux` to the next station
  };
  const std::vector<double> zeros(static_cast<std::size_t>(rows), 0.0);
  std::array<Moments, 3> ring;
  ring.fill({zeros, zeros, zeros, zeros});
  const auto at = [&](int i) -> Moments& { return ring[static_cast<std::size_t>(i + 3) % 3]; };
  const auto finish = [&](int i) {
    if ((i == 0 && !wall_before) || (i == count - 1 && !wall_behind)) return;
    settle(rows, at(i).sum.data(), at(i - 1).flux.data(), at(i).flux.data(), to.at(i) + row_begin);
  };
  for (int i = 0; i < count; ++i) {
    Moments& here = at(i);
    const double* const values = from.at(i) + row_begin;
    moments(taps, rows, weight_.data(), values, here.sum.data(), here.first.data(), here.second.data());
    if (open) exchange_across(taps, rows, weight_.data(), values, mask_of(i), here.sum.data());
    if (i == 0) continue;
    Moments& before = at(i - 1);
    flux_between(rows, frame_.drift(), before.sum.data(), here.sum.data(), before.first.data(),
                 here.first.data(), before.second.data(), here.second.data(), before.flux.data());
    if (open) close_faces(rows, mask_of(i - 1), mask_of(i), before.flux.data());
    finish(i - 1);
  }
  at(count - 1).flux = zeros;
  finish(count - 1);
}

void LateralSpread::run(FrameField& values, int begin, int end, int row_begin, int row_end,
                        const FrameField* open) const {
  if (passes_ == 0) return;
  FrameField result(end - begin, frame_.rows());
  for (int n = 0; n < passes_; ++n) {
    if (n > 0)
      for (int i = 0; i < end - begin; ++i) values.fill_mirrored_pads(i, frame_.periodic());
    pass(values, begin, end - begin, row_begin, row_end, open, result);
    values.swap(result);
  }
}

}  // namespace aeolian
