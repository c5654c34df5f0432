#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include "aeolian_core/wind/inner_layer.hpp"

namespace aeolian {

/// An answer of all ReliefWaves between two wave numbers, from a table: good to some 1e-3 of its greatest
/// value.
class WaveTable {
 public:
  using Answer = std::function<WaveResponse(const ReliefWave&)>;
  WaveTable(const UpwindProfile& upwind, double least_wave_number, double greatest_wave_number,
            const Answer& answer);

  /// `along`, `across` the wind: the components of the wave number [1/m].
  struct Parts {
    float along_real, along_imaginary, across_real, across_imaginary;
  };
  Parts operator()(float along, float across) const {
    const float square = along * along + across * across;
    const float k = std::sqrt(square);
    const int row = std::clamp(bin(square) - first_, 0, rows_ - 1);
    const float column = (columns - 1) * std::sqrt(std::min(std::abs(along) / k, 1.0F));
    const int c = std::min(static_cast<int>(column), columns - 2);
    const float w = column - static_cast<float>(c);
    const Parts* low = &table_[static_cast<std::size_t>(row * columns + c)];
    const Parts& high = low[1];
    const float sign = along < 0 ? -1 : 1;
    return {k * (low->along_real + w * (high.along_real - low->along_real)),
            sign * k * (low->along_imaginary + w * (high.along_imaginary - low->along_imaginary)),
            sign * across * (low->across_real + w * (high.across_real - low->across_real)),
            across * (low->across_imaginary + w * (high.across_imaginary - low->across_imaginary))};
  }

 private:
  static constexpr int columns = 49;  ///< equally spaced in the root of the cosine
  static constexpr int shift = 18;    ///< bits of a float that a bin does not tell: 32 bins to twice k^2
  static int bin(float square) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &square, sizeof bits);
    return static_cast<int>(bits >> shift);
  }

  int first_;
  int rows_;
  std::vector<Parts> table_;  ///< along/k, across/(k sine), at the middle of each bin
};

}  // namespace aeolian
