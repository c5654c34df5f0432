#include "aeolian_core/wind/fourier.hpp"

#include <mutex>

#include <fftw3.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr int block = 16;  ///< columns that are transformed together: two lines of cache of each row
constexpr unsigned how = FFTW_ESTIMATE | FFTW_UNALIGNED;  // a measured plan would depend on the moment

fftwf_complex* raw(std::complex<float>* p) { return reinterpret_cast<fftwf_complex*>(p); }

/// FFTW plans in one thread at a time.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

struct Destroy {
  void operator()(fftwf_plan p) const { fftwf_destroy_plan(p); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftwf_plan>, Destroy>;

}  // namespace

struct Fourier::Plans {
  Plan row_forward, row_inverse;
  Plan columns_forward[block + 1];  ///< by the number of columns
  Plan columns_inverse[block + 1];
};

Fourier::Fourier(int nx, int ny) : nx_(nx), ny_(ny), plans_(std::make_unique<Plans>()) {
  const Require require("Fourier transform");
  require(nx > 0, "columns", nx, "positive");
  require(ny > 0, "rows", ny, "positive");
  const std::lock_guard<std::mutex> lock(planner());
  std::vector<float> row(static_cast<std::size_t>(nx));
  Spectrum spectrum(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(ny));
  plans_->row_forward.reset(fftwf_plan_dft_r2c_1d(nx, row.data(), raw(spectrum.data()), how));
  plans_->row_inverse.reset(fftwf_plan_dft_c2r_1d(nx, raw(spectrum.data()), row.data(), how));
  for (const int n : {std::min(block, columns()), columns() % block}) {
    if (n == 0 || plans_->columns_forward[n]) continue;
    const auto plan = [&](int sign) {
      return fftwf_plan_many_dft(1, &ny_, n, raw(spectrum.data()), nullptr, columns(), 1,
                                 raw(spectrum.data()), nullptr, columns(), 1, sign, how);
    };
    plans_->columns_forward[n].reset(plan(FFTW_FORWARD));
    plans_->columns_inverse[n].reset(plan(FFTW_BACKWARD));
  }
}

Fourier::~Fourier() {
  const std::lock_guard<std::mutex> lock(planner());
  plans_.reset();
}

void Fourier::transform_columns(Spectrum& spectrum, bool forward) const {
  const Plan* plans = forward ? plans_->columns_forward : plans_->columns_inverse;
  tbb::parallel_for(0, (columns() + block - 1) / block, [&](int n) {
    const int first = n * block;
    fftwf_complex* data = raw(spectrum.data() + first);
    fftwf_execute_dft(plans[std::min(block, columns() - first)].get(), data, data);
  });
}

Fourier::Spectrum Fourier::forward(const std::vector<float>& grid) const {
  Spectrum spectrum(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(ny_));
  tbb::parallel_for(tbb::blocked_range<int>(0, ny_, 32), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> row(static_cast<std::size_t>(nx_));
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::copy_n(grid.begin() + static_cast<std::ptrdiff_t>(y) * nx_, nx_, row.begin());
      fftwf_execute_dft_r2c(plans_->row_forward.get(), row.data(),
                            raw(spectrum.data() + static_cast<std::ptrdiff_t>(y) * columns()));
    }
  });
  transform_columns(spectrum, true);
  return spectrum;
}

std::vector<float> Fourier::inverse(Spectrum&& spectrum, int rows) const {
  transform_columns(spectrum, false);
  std::vector<float> grid(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(rows));
  const auto scale = static_cast<float>(1.0 / (static_cast<double>(nx_) * ny_));
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, 32), [&](const tbb::blocked_range<int>& range) {
    for (int y = range.begin(); y < range.end(); ++y) {
      float* row = grid.data() + static_cast<std::ptrdiff_t>(y) * nx_;
      fftwf_execute_dft_c2r(plans_->row_inverse.get(),
                            raw(spectrum.data() + static_cast<std::ptrdiff_t>(y) * columns()), row);
      for (int x = 0; x < nx_; ++x) row[x] *= scale;
    }
  });
  return grid;
}

int Fourier::good_count(int least) {
  for (int n = least + least % 2;; n += 2) {
    int rest = n;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

}  // namespace aeolian
