#include "aeolian_core/measure/power_spectrum.hpp"

#include <cmath>
#include <complex>

#include "aeolian_core/measure/parabola.hpp"

namespace aeolian {

PowerSpectrum::PowerSpectrum(std::size_t count, double step) : step_(step) {
  fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  const auto n = static_cast<Eigen::Index>(count);
  window_ = Eigen::ArrayXd::NullaryExpr(n, [n](Eigen::Index i) {
    return 0.5 - 0.5 * std::cos(2 * M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  });
  while (padded_ < 2 * count) padded_ *= 2;
}

std::vector<double> PowerSpectrum::wavenumber() const {
  std::vector<double> k;
  for (std::size_t i = 1; i <= padded_ / 2; ++i)
    k.push_back(static_cast<double>(i) / (static_cast<double>(padded_) * step_));
  return k;
}

std::vector<double> PowerSpectrum::density(const std::vector<double>& heights) {
  std::vector<double> windowed(padded_, 0.0);
  for (std::size_t i = 0; i < heights.size(); ++i)
    windowed[i] = heights[i] * window_[static_cast<Eigen::Index>(i)];
  std::vector<std::complex<double>> transform;
  fft_.fwd(transform, windowed);
  const double factor = 2 * step_ / window_.square().sum();
  std::vector<double> power;
  for (std::size_t i = 1; i <= padded_ / 2; ++i) power.push_back(factor * std::norm(transform[i]));
  power.back() *= 0.5;  // the Nyquist wavenumber has no twin
  return power;
}

std::optional<double> PowerSpectrum::peak(const std::vector<double>& density, double lowest,
                                          double highest) const {
  const double spacing = 1 / (static_cast<double>(padded_) * step_);
  std::size_t top = 0;
  for (std::size_t i = 1; i + 1 < density.size(); ++i) {
    const double k = spacing * static_cast<double>(i + 1);
    if (k < lowest || k > highest || density[i] < density[i - 1] || density[i] <= density[i + 1]) continue;
    if (top == 0 || density[i] > density[top]) top = i;
  }
  if (top == 0) return std::nullopt;
  const auto vertex =
      parabola_vertex({std::log(density[top - 1]), std::log(density[top]), std::log(density[top + 1])}, 0, 2);
  if (!vertex) return std::nullopt;
  return spacing * (static_cast<double>(top) + vertex->position);
}

}  // namespace aeolian
