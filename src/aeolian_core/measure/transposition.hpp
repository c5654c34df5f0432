#pragma once

#include <cstddef>
#include <cstring>

namespace aeolian {

/// Eight rows of eight floats (or of other four bytes) become eight columns, in registers where the processor
/// has room for them.
class Transposition {
 public:
  static constexpr std::size_t side = 8;

  void take_row(std::size_t i, const void* from) { std::memcpy(&rows_[i], from, sizeof(Row)); }
  void give_row(std::size_t i, void* to) const { std::memcpy(to, &rows_[i], sizeof(Row)); }

  // Pairs, then fours, then halves change places.
  __attribute__((always_inline)) void transpose() {
    Row pairs[side], fours[side];
    for (std::size_t i = 0; i < side; i += 2) {
      pairs[i] = __builtin_shufflevector(rows_[i], rows_[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
      pairs[i + 1] = __builtin_shufflevector(rows_[i], rows_[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    for (std::size_t i = 0; i < side; i += 4) {
      fours[i] = __builtin_shufflevector(pairs[i], pairs[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + 1] = __builtin_shufflevector(pairs[i], pairs[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
      fours[i + 2] = __builtin_shufflevector(pairs[i + 1], pairs[i + 3], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + 3] = __builtin_shufflevector(pairs[i + 1], pairs[i + 3], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    for (std::size_t i = 0; i < side / 2; ++i) {
      rows_[i] = __builtin_shufflevector(fours[i], fours[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
      rows_[i + 4] = __builtin_shufflevector(fours[i], fours[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
  }

 private:
  using Row = float __attribute__((vector_size(side * sizeof(float))));
  Row rows_[side];
};

}  // namespace aeolian
