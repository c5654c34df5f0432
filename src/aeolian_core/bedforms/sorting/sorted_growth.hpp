#pragma once

#include <complex>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/sorting/sorted_forcing.hpp"

namespace aeolian {

/// Linear theory of ripples of two sizes on a flat bed whose layer and sand below have one composition.
class SortedGrowth {
 public:
  SortedGrowth(const SortedForcing& forcing, const RippleParameters& ripples, double coarse_fraction);

  /// Rate [1/s] at which a wave of height of this wave number [1/m] along the wind grows (real part) and
  /// turns (imaginary part, minus wave number times phase speed) while the composition stays as it is: the
  /// mean over the sizes weighted with their fractions.
  std::complex<double> at_fixed_composition(double wave_number) const;

  struct Mode {
    std::complex<double> rate;        ///< [1/s]
    std::complex<double> enrichment;  ///< amplitude of the coarse fraction over that of the height [1/m]
  };
  /// The faster-growing of the two waves in which height and the composition of an active layer of so many
  /// metres change together. Enrichment with a positive real part: coarse crests.
  Mode with_active_layer(double wave_number, double layer) const;

  struct Fastest {
    double wavelength = 0;  ///< [m]
    double rate = 0;        ///< [1/s]; zero or less: nothing grows
  };
  /// The fastest growth at fixed composition.
  Fastest fastest() const;

 private:
  struct Size {
    double fraction, rate, hop;
  };
  /// What a size's grains do to the bed per unit of what is set moving: D - E.
  static std::complex<double> displaced(const Size& size, double wave_number);
  std::complex<double> by_height(const Size& size, double wave_number) const;
  double levelled(double wave_number) const;

  double contrast_, shortening_, slope_effect_;
  Size fine_, coarse_;
};

}  // namespace aeolian
