#include "aeolian_core/measure/length_scales.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/measure/parabola.hpp"

namespace aeolian {

LengthScales::LengthScales(const std::vector<double>& heights, double sigma)
    : heights_((Eigen::Map<const Eigen::ArrayXd>(heights.data(), static_cast<Eigen::Index>(heights.size())) /
                (std::sqrt(2.0) * sigma))
                   .cast<float>()) {}

double LengthScales::alike(std::size_t lag) const {
  const Eigen::Index pairs = heights_.size() - static_cast<Eigen::Index>(lag);
  return static_cast<double>((-(heights_.tail(pairs) - heights_.head(pairs)).square()).exp().mean());
}

std::vector<double> LengthScales::distribution(std::size_t lags) const {
  std::vector<double> f;
  double sum = 0;
  for (std::size_t lag = 1; lag <= lags && lag < static_cast<std::size_t>(heights_.size()); ++lag) {
    f.push_back(alike(lag));
    sum += f.back();
  }
  for (double& value : f) value *= static_cast<double>(f.size()) / sum;
  return f;
}

std::optional<double> LengthScales::dominant(const std::vector<double>& distribution) const {
  double lowest = INFINITY;
  double highest = -INFINITY;
  std::size_t top = 0;
  for (std::size_t i = 0; i < distribution.size(); ++i) {
    const double f = distribution[i];
    // A turn counts when it exceeds the chance scatter of a mean over so many pairs several times.
    const double turn =
        std::max(0.15, 5 / std::sqrt(static_cast<double>(heights_.size()) - static_cast<double>(i + 1)));
    lowest = std::min(lowest, f);
    if (f < lowest + turn && top == 0) continue;
    if (f > highest) {
      highest = f;
      top = i + 1;
    } else if (f < highest - turn) {
      return maximum_near(top);
    }
  }
  return std::nullopt;
}

std::optional<double> LengthScales::maximum_near(std::size_t lag) const {
  // Of a wide top, some twenty lags say enough.
  const std::size_t stride = std::max<std::size_t>(1, lag / 125);
  const std::size_t half = std::max<std::size_t>(1, lag / 25 / stride);
  const std::size_t reach = std::min(2 * half, (lag - 1) / stride);
  const std::size_t first = lag - reach * stride;
  std::vector<double> f;
  for (std::size_t at = first; at <= lag + 2 * half * stride; at += stride) {
    if (at >= static_cast<std::size_t>(heights_.size())) break;
    f.push_back(alike(at));
  }
  const auto top = static_cast<std::size_t>(std::max_element(f.begin(), f.end()) - f.begin());
  if (top < half) return std::nullopt;
  const auto vertex = parabola_vertex(f, top - half, top + half);
  if (!vertex || vertex->curvature >= 0) return std::nullopt;
  return static_cast<double>(first) + static_cast<double>(stride) * vertex->position;
}

}  // namespace aeolian
