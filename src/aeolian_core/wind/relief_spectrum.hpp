#pragma once

#include <complex>
#include <memory>

#include "aeolian_core/wind/fourier.hpp"
#include "aeolian_core/wind/wind_relief.hpp"

namespace aeolian {

/// The waves of a relief. Without mean and tilt; a map that does not repeat lies in a grid of at least twice
/// its size, in which its border sinks smoothly to the level of its middle plane, so that the wind of one
/// border does not meet the relief of the other. A map of one row (or column) is a ridge without end.
class ReliefSpectrum {
 public:
  explicit ReliefSpectrum(const WindRelief& relief);

  const Fourier& fourier() const { return *fourier_; }
  const Fourier::Spectrum& spectrum() const { return spectrum_; }
  /// Periods become wave numbers by these [1/m].
  double unit_x() const { return unit_x_; }
  double unit_y() const { return unit_y_; }
  /// Calls visit(index in the spectrum, k_x, k_y) for every wave of row `row` but the mean and those whose
  /// sign the grid cannot tell.
  template <class Visit>
  void for_each_wave(int row, Visit&& visit) const {
    const int wave_y = fourier_->wave_y(row);
    if (fourier_->ny() > 1 && 2 * wave_y == fourier_->ny()) return;
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(fourier_->columns());
    for (int ix = wave_y == 0 ? 1 : 0; ix < fourier_->columns(); ++ix) {
      if (ix > 0 && 2 * ix == fourier_->nx()) continue;
      visit(first + static_cast<std::size_t>(ix), ix * unit_x_, wave_y * unit_y_);
    }
  }
  double longest() const;   ///< wave number of the longest wave along an axis [1/m]
  double shortest() const;  ///< the greatest wave number [1/m]

 private:
  std::unique_ptr<Fourier> fourier_;
  Fourier::Spectrum spectrum_;
  double unit_x_;
  double unit_y_;
};

}  // namespace aeolian
