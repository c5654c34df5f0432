#include "aeolian_core/measure/ripple_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr double shortest_cells = 5;
constexpr double fewest_waves = 2.5;  ///< in the map
constexpr double least_cosine = 0.5;  ///< of the angle to the direction asked for

/// The periodogram of a layer under a Hann window; wavenumbers wrap around as usual. `weight` gets the
/// window's sum of squares, the expected power of white noise of unit variance.
cv::Mat periodogram(const GridGeometry& g, const HeightMap::Layer& level, double& weight) {
  const auto hann = [](int n) {
    return Eigen::ArrayXd::NullaryExpr(n,
                                       [n](Eigen::Index i) {
                                         return 0.5 -
                                                0.5 * std::cos(2 * M_PI * (static_cast<double>(i) + 0.5) / n);
                                       })
        .eval();
  };
  const Eigen::ArrayXd across = hann(g.nx());
  const Eigen::ArrayXd up = hann(g.ny());
  weight = across.square().sum() * up.square().sum();
  cv::Mat_<float> image(g.ny(), g.nx());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      image(y, x) = static_cast<float>(across[x] * up[y]) * level[g.index(x, y)];
  cv::Mat padded;
  cv::copyMakeBorder(image, padded, 0, cv::getOptimalDFTSize(g.ny()) - g.ny(), 0,
                     cv::getOptimalDFTSize(g.nx()) - g.nx(), cv::BORDER_CONSTANT, 0);
  cv::Mat transform;
  cv::dft(padded, transform, cv::DFT_COMPLEX_OUTPUT);
  std::vector<cv::Mat> parts;
  cv::split(transform, parts);
  return parts[0].mul(parts[0]) + parts[1].mul(parts[1]);
}

/// A place of a spectrum.
struct Wave {
  double k = 0;       ///< [1/m]
  double along = 0;   ///< of the wave vector, in the direction asked for [1/m]
  double across = 0;  ///< to the left of it [1/m]
  double angle() const { return std::atan2(across, along); }
};

/// Calls visit(row, column, wave) for the waves that may be ripples.
template <class Visit>
void each_wave(const GridGeometry& g, const cv::Mat& power, double direction, const Visit& visit) {
  const double longest_k = 1 / (shortest_cells * g.cell());
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  for (int j = 0; j < power.rows; ++j) {
    const double ky = (j <= power.rows / 2 ? j : j - power.rows) / (power.rows * g.cell());
    if (std::abs(ky) > longest_k) continue;
    for (int i = 0; i < power.cols; ++i) {
      const double kx = (i <= power.cols / 2 ? i : i - power.cols) / (power.cols * g.cell());
      const double along = c * kx + s * ky;
      const double squared = kx * kx + ky * ky;
      if (along <= 0 || squared > longest_k * longest_k ||
          along * along < least_cosine * least_cosine * squared)
        continue;
      const double waves_x = kx * g.length_x();
      const double waves_y = ky * g.length_y();
      if (waves_x * waves_x + waves_y * waves_y < fewest_waves * fewest_waves) continue;
      visit(j, i, Wave{std::sqrt(squared), along, c * ky - s * kx});
    }
  }
}

}  // namespace

double cell_noise(const GridGeometry& g, const HeightMap::Layer& elevation) {
  constexpr std::size_t enough = 200000;  // for a median to half a percent
  const std::size_t stride = 1 + g.size() / enough;
  std::vector<float> differences;
  std::size_t number = 0;
  for (int y = 1; y + 1 < g.ny(); ++y) {
    const float* below = elevation.data() + g.index(0, y - 1);
    const float* here = elevation.data() + g.index(0, y);
    const float* above = elevation.data() + g.index(0, y + 1);
    for (int x = 1; x + 1 < g.nx(); ++x) {
      if (number++ % stride != 0) continue;
      const float d = below[x - 1] - 2 * below[x] + below[x + 1] - 2 * here[x - 1] + 4 * here[x] -
                      2 * here[x + 1] + above[x - 1] - 2 * above[x] + above[x + 1];
      if (std::isfinite(d)) differences.push_back(std::abs(d));
    }
  }
  return sigma_per_median / 6 * static_cast<double>(median(std::move(differences)));
}

std::optional<RipplePattern> find_pattern(const GridGeometry& g, const HeightMap::Layer& level,
                                          double direction, double noise) {
  constexpr double peak_width = 0.4;  // of its wavenumber, to either side
  constexpr double peak_angle = 0.6;  // [rad]
  constexpr double least_ratio = 2;   // of variance in the peak to that of noise
  if (std::min(g.nx(), g.ny()) < 3) return std::nullopt;
  double weight = 0;
  const cv::Mat_<float> power = periodogram(g, level, weight);
  cv::Mat_<float> smooth;
  cv::GaussianBlur(power, smooth, {}, 1.5);

  const double floor = noise * noise * weight;
  double best = 0;
  Wave top;
  each_wave(g, power, direction, [&](int j, int i, const Wave& wave) {
    const double value = (static_cast<double>(smooth(j, i)) - floor) * wave.k;
    if (value <= best) return;
    best = value;
    top = wave;
  });
  if (!(best > 0)) return std::nullopt;

  double total = 0;
  double expected = 0;
  double excess = 0;
  double k = 0;
  double angle = 0;
  each_wave(g, power, direction, [&](int j, int i, const Wave& wave) {
    if (std::abs(wave.k - top.k) > peak_width * top.k || std::abs(wave.angle() - top.angle()) > peak_angle)
      return;
    const double value = static_cast<double>(power(j, i));
    total += value;
    expected += floor;
    const double over = std::max(0.0, value - 3 * floor);
    excess += over;
    k += over * wave.k;
    angle += over * wave.angle();
  });
  if (!(total > least_ratio * expected && excess > 0)) return std::nullopt;
  return RipplePattern{excess / k, direction + angle / excess};
}

}  // namespace aeolian
