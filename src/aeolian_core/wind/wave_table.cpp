#include "aeolian_core/wind/wave_table.hpp"

#include <tbb/parallel_for.h>

namespace aeolian {

WaveTable::WaveTable(const UpwindProfile& upwind, double least_wave_number, double greatest_wave_number,
                     const Answer& answer)
    : first_(std::log2(least_wave_number) - 1e-3),
      rows_(static_cast<int>(std::ceil((std::log2(greatest_wave_number) - first_) * per_octave)) + 2),
      table_(static_cast<std::size_t>(rows_ * columns)) {
  last_row_ = rows_ - 1;
  tbb::parallel_for(0, rows_, [&](int row) {
    const double k = std::exp2(first_ + static_cast<double>(row) / per_octave);
    for (int column = 0; column < columns; ++column) {
      const double root = static_cast<double>(column) / (columns - 1);
      // Per unit of the sine, which ReliefWave takes as it is given.
      const WaveResponse r = answer(ReliefWave(upwind, k, root * root, 1));
      table_[static_cast<std::size_t>(row * columns + column)] = {
          {r.along.real() / k, r.along.imag() / k, r.across.real() / k, r.across.imag() / k}};
    }
  });
}

}  // namespace aeolian
