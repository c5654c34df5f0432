#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "aeolian_core/wind/inner_layer.hpp"

namespace aeolian {

/// An answer of all ReliefWaves between two wave numbers, from a table: good to some 1e-3 of its greatest value.
class WaveTable {
 public:
  using Answer = std::function<WaveResponse(const ReliefWave&)>;
  WaveTable(const UpwindProfile& upwind, double least_wave_number, double greatest_wave_number,
            const Answer& answer);

  /// `along`, `across` the wind, wave number k and its components [1/m].
  WaveResponse operator()(double k, double along, double across) const {
    const double cosine = along / k;
    const double row = std::min((std::log2(static_cast<float>(k)) - first_) * per_octave, last_row_);
    const double column = (columns - 1) * std::sqrt(std::abs(cosine));
    const int r = std::min(static_cast<int>(row), rows_ - 2);
    const int c = std::min(static_cast<int>(column), columns - 2);
    const double wr = row - r;
    const double wc = column - c;
    const Entry* low = &table_[static_cast<std::size_t>(r * columns + c)];
    const Entry* high = low + columns;
    const double weights[] = {(1 - wr) * (1 - wc), (1 - wr) * wc, wr * (1 - wc), wr * wc};
    double sum[4];
    for (int i = 0; i < 4; ++i)
      sum[i] = weights[0] * low[0].value[i] + weights[1] * low[1].value[i] + weights[2] * high[0].value[i] +
               weights[3] * high[1].value[i];
    const double sign = cosine < 0 ? -1 : 1;
    return {{k * sum[0], sign * k * sum[1]}, {sign * across * sum[2], across * sum[3]}};
  }

 private:
  static constexpr int per_octave = 4;
  static constexpr int columns = 49;  ///< equally spaced in the root of the cosine
  /// along/k, real and imaginary; across/(k sine).
  struct Entry {
    double value[4];
  };

  double first_;
  double last_row_;
  int rows_;
  std::vector<Entry> table_;
};

}  // namespace aeolian
