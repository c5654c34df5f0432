#include "aeolian_core/wind/wave_table.hpp"

#include <tbb/parallel_for.h>

namespace aeolian {
namespace {

constexpr int solved_every = 16;  ///< bins: answers vary little over the quarter of an octave between

}  // namespace

WaveTable::WaveTable(const UpwindProfile& upwind, double least_wave_number, double greatest_wave_number,
                     const Answer& answer) {
  const auto square = [](double k) { return static_cast<float>(k * k); };
  first_ = bin(square(least_wave_number));
  const int needed = bin(square(greatest_wave_number)) - first_ + 1;
  const int knots = (needed + solved_every - 1) / solved_every + 1;
  rows_ = (knots - 1) * solved_every + 1;
  table_.resize(static_cast<std::size_t>(rows_ * columns));
  const auto row = [&](int r) { return &table_[static_cast<std::size_t>(r * columns)]; };
  tbb::parallel_for(0, knots, [&](int knot) {
    const std::uint32_t bits =
        (static_cast<std::uint32_t>(first_ + knot * solved_every) << shift) + (1U << (shift - 1));
    float middle = 0;
    std::memcpy(&middle, &bits, sizeof middle);
    const double k = std::sqrt(static_cast<double>(middle));
    // A wave square to the wind is not shifted, and has nothing across.
    row(knot * solved_every)[0] = {static_cast<float>(answer(ReliefWave(upwind, k, 0, 1)).along.real() / k),
                                   0, 0, 0};
    for (int column = 1; column < columns; ++column) {
      const double root = static_cast<double>(column) / (columns - 1);
      // Per unit of the sine, which ReliefWave takes as it is given.
      const WaveResponse r = answer(ReliefWave(upwind, k, root * root, 1));
      row(knot * solved_every)[column] = {
          static_cast<float>(r.along.real() / k), static_cast<float>(r.along.imag() / k),
          static_cast<float>(r.across.real() / k), static_cast<float>(r.across.imag() / k)};
    }
  });
  tbb::parallel_for(0, knots - 1, [&](int knot) {
    const Parts* low = row(knot * solved_every);
    const Parts* high = row((knot + 1) * solved_every);
    for (int r = 1; r < solved_every; ++r) {
      const float w = static_cast<float>(r) / solved_every;
      const auto mix = [w](float a, float b) { return a + w * (b - a); };
      Parts* between = row(knot * solved_every + r);
      for (int c = 0; c < columns; ++c)
        between[c] = {mix(low[c].along_real, high[c].along_real),
                      mix(low[c].along_imaginary, high[c].along_imaginary),
                      mix(low[c].across_real, high[c].across_real),
                      mix(low[c].across_imaginary, high[c].across_imaginary)};
    }
  });
}

}  // namespace aeolian
