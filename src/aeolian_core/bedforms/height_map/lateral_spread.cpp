#include "aeolian_core/bedforms/height_map/lateral_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

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

/// Calls work with the number of taps as a constant, over which its loops are unrolled.
template <int most, class Work>
AEOLIAN_INLINE void with_taps(int taps, const Work& work) {
  if constexpr (most > 1) {
    if (taps < most) return with_taps<most - 1>(taps, work);
  }
  work(std::integral_constant<int, most>());
}

AEOLIAN_WIDE_KERNEL void moments(int taps, std::ptrdiff_t count, const double* weight,
                                 const double* __restrict v, double* __restrict sum, double* __restrict first,
                                 double* __restrict second) {
  with_taps<most_taps>(
      taps, [=](auto n) __attribute__((always_inline)) {
        sum_taps<decltype(n)::value>(count, weight, v, sum, first, second);
      });
}

AEOLIAN_WIDE_KERNEL void mean_across(int taps, std::ptrdiff_t count, const double* weight,
                                     const double* __restrict v, double* __restrict sum) {
  with_taps<most_taps>(
      taps, [=](auto n) __attribute__((always_inline)) {
        sum_taps_straight<decltype(n)::value>(count, weight, v, sum);
      });
}

/// The sum of the taps where some cells are closed: each pair of cells exchanges by itself.
AEOLIAN_WIDE_KERNEL void exchange_across(int taps, std::ptrdiff_t count, const double* weight,
                                         const double* __restrict v, const double* __restrict open,
                                         double* __restrict sum) {
  for (std::ptrdiff_t i = 0; i < count; ++i) sum[i] = v[i];
  for (int m = 1; m <= taps; ++m)
    for (std::ptrdiff_t i = 0; i < count; ++i)
      sum[i] += weight[m] * open[i] * (open[i + m] * (v[i + m] - v[i]) + open[i - m] * (v[i - m] - v[i]));
}

AEOLIAN_WIDE_KERNEL void close_faces(std::ptrdiff_t count, const double* __restrict open,
                                     const double* __restrict next_open, double* __restrict flux) {
  for (std::ptrdiff_t i = 0; i < count; ++i) flux[i] *= open[i] * next_open[i];
}

/// Moves the taps m rows away by m times the drift upwind: the flux between two stations that this is, and no
/// more of it than half of what is there.
AEOLIAN_WIDE_KERNEL void flux_between(std::ptrdiff_t count, double drift, const double* __restrict sum,
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

AEOLIAN_WIDE_KERNEL void settle(std::ptrdiff_t count, const double* __restrict sum,
                                const double* __restrict in, const double* __restrict out,
                                double* __restrict result) {
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

LateralSpread::Stream::Stream(const LateralSpread& spread, int begin, int end, int row_begin, int row_end,
                              const FrameField* open)
    : spread_(spread),
      begin_(begin),
      end_(end),
      next_(begin),
      row_begin_(row_begin),
      row_end_(row_end),
      open_(open),
      wall_before_(!spread.frame_.periodic() && begin == 0),
      wall_behind_(!spread.frame_.periodic() && end == spread.frame_.stations()),
      rows_(spread.passes_ + 1, spread.frame_.rows()) {
  if (spread.frame_.drift() != 0) moments_ = FrameField(spread.passes_ * 4 * 3, spread.frame_.rows());
}

const double* LateralSpread::Stream::open_at(int station) const {
  const int n = spread_.frame_.stations();
  return open_->at((station % n + n) % n) + row_begin_;
}

void LateralSpread::Stream::fold(int pass, int station) {
  const int rows = row_end_ - row_begin_;
  const int taps = static_cast<int>(spread_.weight_.size()) - 1;
  const double* const weight = spread_.weight_.data();
  const bool straight = spread_.frame_.drift() == 0;
  rows_.fill_mirrored_pads(pass, spread_.frame_.periodic());
  const double* const values = rows_.at(pass) + row_begin_;
  double* const folded = straight ? rows_.at(pass + 1) + row_begin_ : moment(pass, sum, station);
  if (straight)
    mean_across(taps, rows, weight, values, folded);
  else
    moments(taps, rows, weight, values, folded, moment(pass, first, station), moment(pass, second, station));
  if (open_) exchange_across(taps, rows, weight, values, open_at(station), folded);
}

void LateralSpread::Stream::flow(int pass, int station) {
  const int rows = row_end_ - row_begin_;
  const auto at = [&](Moment which, int where) { return moment(pass, which, where); };
  flux_between(rows, spread_.frame_.drift(), at(sum, station), at(sum, station + 1), at(first, station),
               at(first, station + 1), at(second, station), at(second, station + 1), at(flux, station));
  if (open_) close_faces(rows, open_at(station), open_at(station + 1), at(flux, station));
}

void LateralSpread::Stream::close(int pass, int station) {
  std::fill_n(moment(pass, flux, station), row_end_ - row_begin_, 0.0);
}

void LateralSpread::Stream::add_up(int pass, int station) {
  settle(row_end_ - row_begin_, moment(pass, sum, station), moment(pass, flux, station - 1),
         moment(pass, flux, station), rows_.at(pass + 1) + row_begin_);
}

}  // namespace aeolian
