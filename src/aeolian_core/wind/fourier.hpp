#pragma once

#include <complex>
#include <memory>
#include <vector>

namespace aeolian {

/// Fourier transforms of a real grid of nx x ny, row by row, in single precision (FFTW, several threads;
/// the same bits for any number of them).
///
/// A spectrum holds nx/2 + 1 numbers in each of ny rows: wave (ix, iy) has ix periods along x and iy, or
/// iy - ny where that is nearer to zero, along y.
class Fourier {
 public:
  using Spectrum = std::vector<std::complex<float>>;

  /// Throws Error unless both counts are positive.
  Fourier(int nx, int ny);
  ~Fourier();
  Fourier(const Fourier&) = delete;
  Fourier& operator=(const Fourier&) = delete;

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int columns() const { return nx_ / 2 + 1; }
  /// Signed periods along y of a row of a spectrum.
  int wave_y(int row) const { return row <= ny_ / 2 ? row : row - ny_; }

  /// The sum of grid exp(-i ...), not normalised. `grid`: nx * ny values.
  Spectrum forward(const std::vector<float>& grid) const;
  /// The sum of spectrum exp(+i ...) over nx ny, of the first `rows` rows; the spectrum is used up.
  std::vector<float> inverse(Spectrum&& spectrum, int rows) const;

  /// The smallest count of small factors, even, that is not less.
  static int good_count(int least);

 private:
  struct Plans;
  void transform_columns(Spectrum& spectrum, bool forward) const;

  int nx_;
  int ny_;
  std::unique_ptr<Plans> plans_;
};

}  // namespace aeolian
