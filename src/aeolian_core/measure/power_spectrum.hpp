#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

namespace aeolian {

/// The periodogram of detrended heights under a Hann window, padded with zeros to at least twice their
/// length so that a parabola finds the top of a peak.
class PowerSpectrum {
 public:
  /// For `count` heights a `step` [m] apart.
  PowerSpectrum(std::size_t count, double step);

  /// Cycles per metre, rising by a constant from the first above zero to the Nyquist wavenumber [1/m].
  std::vector<double> wavenumber() const;
  /// One-sided density over them [m^3]: its integral is the variance of the heights [m^2].
  std::vector<double> density(const std::vector<double>& heights);
  /// The highest maximum of a density between two wavenumbers, refined by a parabola on its logarithm [1/m].
  std::optional<double> peak(const std::vector<double>& density, double lowest, double highest) const;

 private:
  Eigen::FFT<double> fft_;
  Eigen::ArrayXd window_;
  double step_;
  std::size_t padded_ = 1;
};

}  // namespace aeolian
