#include "aeolian_core/twin/line_spectra.hpp"

#include <algorithm>
#include <limits>

namespace aeolian {
namespace {

constexpr int strip_count = 8;
constexpr int few_lines = 2 * strip_count;

/// Offset of the top of the parabola through three equidistant values, in steps from the middle one.
double parabola_top(const LineCorrelation::Curve& curve, std::size_t middle) {
  const double before = curve[middle - 1];
  const double after = curve[middle + 1];
  const double curvature = before - 2 * curve[middle] + after;
  return curvature < 0 ? 0.5 * (before - after) / curvature : 0;
}

cv::Mat transformed(const std::vector<float>& values, int count, int length, int padded, bool squared) {
  cv::Mat_<float> rows(count, padded, 0.0F);
  for (int line = 0; line < count; ++line) {
    const float* from = values.data() + static_cast<std::size_t>(line) * static_cast<std::size_t>(length);
    float* to = rows[line];
    for (int i = 0; i < length; ++i) to[i] = squared ? from[i] * from[i] : from[i];
  }
  cv::dft(rows, rows, cv::DFT_ROWS);
  return rows;
}

/// The sums over pairs of samples from which a correlation coefficient follows, each by lag.
struct PairSums {
  enum : std::size_t { n, a, b, aa, bb, ab, count };
  std::array<std::vector<double>, count> of;

  void add(const PairSums& other, double sign) {
    for (std::size_t q = 0; q < count; ++q) {
      of[q].resize(other.of[q].size());
      for (std::size_t i = 0; i < of[q].size(); ++i) of[q][i] += sign * other.of[q][i];
    }
  }
};

/// Sums of earlier(x) later(x + lag) over some lines, for lags -reach..reach.
std::vector<double> pair_sum(const cv::Mat& earlier, const cv::Mat& later, const cv::Range& lines,
                             int reach) {
  cv::Mat product;
  cv::mulSpectrums(later.rowRange(lines), earlier.rowRange(lines), product, cv::DFT_ROWS, true);
  cv::Mat sum;
  cv::reduce(product, sum, 0, cv::REDUCE_SUM, CV_64F);
  cv::Mat_<double> by_lag;
  cv::idft(sum, by_lag, cv::DFT_ROWS | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  std::vector<double> result;
  for (int lag = -reach; lag <= reach; ++lag) result.push_back(by_lag(0, lag < 0 ? lag + by_lag.cols : lag));
  return result;
}

LineCorrelation::Curve coefficients(const PairSums& sums, double samples) {
  LineCorrelation::Curve curve;
  for (std::size_t i = 0; i < sums.of[PairSums::n].size(); ++i) {
    const double n = sums.of[PairSums::n][i];
    const double a = sums.of[PairSums::a][i];
    const double b = sums.of[PairSums::b][i];
    const double variance_a = sums.of[PairSums::aa][i] - a * a / n;
    const double variance_b = sums.of[PairSums::bb][i] - b * b / n;
    constexpr double rounding = 1e-5;  // of sums of floats
    const bool varies =
        variance_a > rounding * sums.of[PairSums::aa][i] && variance_b > rounding * sums.of[PairSums::bb][i];
    curve.push_back(n < 0.05 * samples || !varies
                        ? NAN
                        : (sums.of[PairSums::ab][i] - a * b / n) / std::sqrt(variance_a * variance_b));
  }
  return curve;
}

}  // namespace

LineSpectra::LineSpectra(const DirectionalLines& lines)
    : length_(lines.length),
      padded_(cv::getOptimalDFTSize(lines.length + lines.length / 2 + 2)),
      all_(transforms_of(lines)) {
  if (lines.count >= few_lines) return;
  for (int part = 0; part < strip_count; ++part) {
    DirectionalLines rest = lines;
    for (int line = 0; line < lines.count; ++line)
      for (int i = part * lines.length / strip_count; i < (part + 1) * lines.length / strip_count; ++i) {
        const std::size_t at = lines.start(line) + static_cast<std::size_t>(i);
        rest.value[at] = 0;
        rest.known[at] = 0;
      }
    with_gap_.push_back(transforms_of(rest));
  }
}

LineSpectra::Transforms LineSpectra::transforms_of(const DirectionalLines& lines) const {
  return {transformed(lines.value, lines.count, length_, padded_, false),
          transformed(lines.value, lines.count, length_, padded_, true),
          transformed(lines.known, lines.count, length_, padded_, false)};
}

LineCorrelation::LineCorrelation(const LineSpectra& earlier, const LineSpectra& later)
    : reach_(earlier.length_ / 2 + 1) {
  const auto sums_of = [&](const LineSpectra::Transforms& a, const LineSpectra::Transforms& b,
                           const cv::Range& lines) {
    return PairSums{{pair_sum(a.known, b.known, lines, reach_), pair_sum(a.value, b.known, lines, reach_),
                     pair_sum(a.known, b.value, lines, reach_), pair_sum(a.square, b.known, lines, reach_),
                     pair_sum(a.known, b.square, lines, reach_), pair_sum(a.value, b.value, lines, reach_)}};
  };
  const int count = earlier.all_.value.rows;
  const double samples = static_cast<double>(count) * earlier.length_;
  if (!earlier.with_gap_.empty()) {
    curve_ = coefficients(sums_of(earlier.all_, later.all_, {0, count}), samples);
    for (std::size_t part = 0; part < earlier.with_gap_.size(); ++part)
      without_.push_back(
          coefficients(sums_of(earlier.with_gap_[part], later.with_gap_[part], {0, count}), samples));
    return;
  }
  std::vector<PairSums> strips;
  PairSums total;
  for (int part = 0; part < strip_count; ++part) {
    strips.push_back(
        sums_of(earlier.all_, later.all_, {part * count / strip_count, (part + 1) * count / strip_count}));
    total.add(strips.back(), 1);
  }
  curve_ = coefficients(total, samples);
  for (const PairSums& strip : strips) {
    PairSums rest = total;
    rest.add(strip, -1);
    without_.push_back(coefficients(rest, samples));
  }
}

Figure LineCorrelation::jackknifed(const std::function<std::optional<double>(const Curve&)>& estimate) const {
  const auto value = estimate(curve_);
  if (!value) return {NAN, NAN};
  double sum = 0;
  double squares = 0;
  for (const Curve& curve : without_) {
    const auto without = estimate(curve);
    if (!without) return {NAN, NAN};
    const double off = *without - *value;
    sum += off;
    squares += off * off;
  }
  const auto groups = static_cast<double>(without_.size());
  return {*value, std::sqrt(std::max(0.0, (groups - 1) / groups * (squares - sum * sum / groups)))};
}

std::optional<double> repeating_lag(const LineCorrelation::Curve& curve) {
  // A turn counts once the correlation has come back by this much: smaller ones are the estimate's own
  // jitter.
  constexpr double turn = 0.02;
  constexpr double weakest = 0.1;
  double lowest = 1;
  const std::size_t zero = curve.size() / 2;
  std::size_t top = 0;
  for (std::size_t i = zero + 1; i < curve.size(); ++i) {
    if (std::isnan(curve[i])) return std::nullopt;
    if (top == 0) {
      lowest = std::min(lowest, curve[i]);
      if (curve[i] > lowest + turn) top = i;
    } else if (curve[i] > curve[top]) {
      top = i;
    } else if (curve[i] < curve[top] - turn) {
      if (curve[top] < weakest) return std::nullopt;
      return static_cast<double>(top - zero) + parabola_top(curve, top);
    }
  }
  return std::nullopt;
}

std::optional<double> lag_of_best_match(const LineCorrelation::Curve& curve, double range) {
  constexpr double weakest = 0.2;
  constexpr double equal = 0.01;
  const auto zero = static_cast<double>(curve.size() / 2);
  std::vector<std::size_t> tops;
  double highest = weakest;
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    if (std::abs(static_cast<double>(i) - zero) > range + 1) continue;
    if (!(curve[i] > weakest && curve[i] >= curve[i - 1] && curve[i] > curve[i + 1])) continue;
    tops.push_back(i);
    highest = std::max(highest, curve[i]);
  }
  std::optional<double> best;
  for (const std::size_t i : tops) {
    const double lag = static_cast<double>(i) - zero + parabola_top(curve, i);
    if (curve[i] > highest - equal && std::abs(lag) <= range && (!best || std::abs(lag) < std::abs(*best)))
      best = lag;
  }
  return best;
}

}  // namespace aeolian
