#include "aeolian_core/twin/coherence.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <opencv2/core.hpp>

namespace aeolian {
namespace {

constexpr int most_lines = 64;
using Complex = std::complex<float>;
/// A row for each segment of the lines.
using Rows = cv::Mat_<cv::Vec2f>;

/// Where a segment starts.
struct Segment {
  int line;
  int start;
};

std::vector<int> lines_used(const DirectionalLines& lines) {
  const int stride = (lines.count + most_lines - 1) / most_lines;
  std::vector<int> result;
  for (int line = stride / 2; line < lines.count; line += stride) result.push_back(line);
  return result;
}

bool seen(const DirectionalLines& lines, const Segment& at, int length) {
  const float* known = lines.known.data() + lines.start(at.line) + at.start;
  float sum = 0;
  for (int i = 0; i < length; ++i) sum += known[i];
  return sum >= 0.9F * static_cast<float>(length);
}

/// Transforms of segments without their known mean, under the window. Row by row.
Rows transforms(const DirectionalLines& lines, const std::vector<Segment>& segments, int length) {
  cv::Mat_<float> windowed(static_cast<int>(segments.size()), length);
  std::vector<float> window;
  for (int i = 0; i < length; ++i)
    window.push_back(static_cast<float>(0.5 - 0.5 * std::cos(2 * M_PI * (i + 0.5) / length)));
  for (int row = 0; row < windowed.rows; ++row) {
    const Segment& at = segments[static_cast<std::size_t>(row)];
    const float* value = lines.value.data() + lines.start(at.line) + at.start;
    const float* known = lines.known.data() + lines.start(at.line) + at.start;
    float sum = 0;
    float cells = 0;
    for (int i = 0; i < length; ++i) {
      sum += value[i];
      cells += known[i];
    }
    const float mean = sum / cells;
    for (int i = 0; i < length; ++i)
      windowed(row, i) = window[static_cast<std::size_t>(i)] * (value[i] - mean * known[i]);
  }
  Rows result;
  cv::dft(windowed, result, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
  return result;
}

/// Places of a line's segments, apart by half a segment.
std::vector<int> starts(int line_length, int segment) {
  std::vector<int> result;
  for (int start = 0; start + segment <= line_length; start += std::max(1, segment / 2))
    result.push_back(start);
  return result;
}

/// How many independent lines the used ones are worth at a wavenumber: the variance of a cross-spectrum of
/// unrelated surfaces over lines is that of one line times the sum of rho_a conj(rho_b) over all pairs of
/// lines, rho the correlation of a surface with itself from line to line.
class IndependentLines {
 public:
  IndependentLines(const Rows& a, const Rows& b, const std::vector<Segment>& segments, std::size_t lines)
      : a_(a), b_(b), rows_(lines) {
    for (std::size_t row = 0; row < segments.size(); ++row) {
      const auto line = static_cast<std::size_t>(segments[row].line);
      rows_[line].emplace_back(segments[row].start, static_cast<int>(row));
    }
    rows_.erase(std::remove_if(rows_.begin(), rows_.end(), [](const auto& r) { return r.empty(); }),
                rows_.end());
  }

  double at(int wavenumber) const {
    const std::size_t n = rows_.size();
    const double power_a = lagged(a_, 0, wavenumber).real();
    const double power_b = lagged(b_, 0, wavenumber).real();
    double sum = static_cast<double>(n);
    for (std::size_t lag = 1; lag < n; ++lag) {
      const std::complex<double> product =
          lagged(a_, lag, wavenumber) * std::conj(lagged(b_, lag, wavenumber));
      sum += 2 * static_cast<double>(n - lag) * product.real() / (power_a * power_b);
    }
    const double worth = static_cast<double>(n) * static_cast<double>(n) / sum;
    return sum > 0 ? std::clamp(worth, 1.0, static_cast<double>(n)) : static_cast<double>(n);
  }

 private:
  /// Mean product of segments at the same place of lines so far apart.
  std::complex<double> lagged(const Rows& rows, std::size_t lag, int k) const {
    std::complex<double> sum = 0;
    int pairs = 0;
    for (std::size_t line = 0; line + lag < rows_.size(); ++line)
      for (std::size_t i = 0; i < std::min(rows_[line].size(), rows_[line + lag].size()); ++i) {
        if (rows_[line][i].first != rows_[line + lag][i].first) continue;
        const cv::Vec2f& u = rows(rows_[line][i].second, k);
        const cv::Vec2f& v = rows(rows_[line + lag][i].second, k);
        sum += std::complex<double>(Complex(u[0], u[1]) * std::conj(Complex(v[0], v[1])));
        ++pairs;
      }
    return pairs > 0 ? sum / static_cast<double>(pairs) : 0.0;
  }

  const Rows& a_;
  const Rows& b_;
  std::vector<std::vector<std::pair<int, int>>> rows_;  ///< of each line: start of the segment and its row
};

}  // namespace

Coherence coherence(const DirectionalLines& a, const DirectionalLines& b, double cell, int segment) {
  constexpr double worth_of_overlapping = 0.947;
  std::vector<Segment> segments;
  std::size_t lines = 0;
  for (const int line : lines_used(a)) {
    const std::size_t before = segments.size();
    for (const int start : starts(a.length, segment))
      if (seen(a, {line, start}, segment) && seen(b, {line, start}, segment))
        segments.push_back({line, start});
    lines += segments.size() > before ? 1 : 0;
  }
  Coherence result;
  if (segments.size() < 2) return result;
  const Rows of_a = transforms(a, segments, segment);
  const Rows of_b = transforms(b, segments, segment);
  const IndependentLines independent(of_a, of_b, segments, static_cast<std::size_t>(a.count));
  const double per_line = static_cast<double>(segments.size()) / static_cast<double>(lines);
  const double worth_of_line = per_line > 1 ? worth_of_overlapping * per_line : per_line;
  // The window mixes the mean into the first two wavenumbers.
  for (int k = 2; k <= segment / 2; ++k) {
    double power_a = 0;
    double power_b = 0;
    std::complex<double> cross = 0;
    for (int row = 0; row < of_a.rows; ++row) {
      const std::complex<double> u(static_cast<double>(of_a(row, k)[0]),
                                   static_cast<double>(of_a(row, k)[1]));
      const std::complex<double> v(static_cast<double>(of_b(row, k)[0]),
                                   static_cast<double>(of_b(row, k)[1]));
      power_a += std::norm(u);
      power_b += std::norm(v);
      cross += u * std::conj(v);
    }
    const double count = worth_of_line * independent.at(k);
    if (!(count > 1) || !(power_a > 0) || !(power_b > 0)) continue;
    const double squared = std::min(1.0, std::norm(cross) / (power_a * power_b));
    result.wavelength.push_back(segment * cell / k);
    result.squared.push_back(squared);
    result.sigma.push_back(std::sqrt(2 * squared / count) * (1 - squared));
    result.level95.push_back(1 - std::pow(0.05, 1 / (count - 1)));
  }
  return result;
}

}  // namespace aeolian
