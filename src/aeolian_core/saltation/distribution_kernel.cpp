#include "aeolian_core/saltation/distribution_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr double fastest_launch = 50;  ///< no bed throws grains faster [m/s]

constexpr Require require{"distribution splash"};

/// Cumulative normal distribution, from a table: good to 2e-6.
class Normal {
 public:
  Normal() {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = 0.5 * std::erfc(-(static_cast<double>(i) / per_unit - range) / M_SQRT2);
  }
  double operator()(double z) const {
    if (z <= -range) return 0;
    if (z >= range) return 1;
    const double at = (z + range) * per_unit;
    const auto i = static_cast<std::size_t>(at);
    return table_[i] + (at - static_cast<double>(i)) * (table_[i + 1] - table_[i]);
  }
  static constexpr double range = 6;

 private:
  static constexpr double per_unit = 128;
  std::array<double, static_cast<std::size_t>(2 * range * per_unit) + 2> table_;
};

}  // namespace

DistributionKernel::DistributionKernel(const DistributionSplash::Parameters& p, double width, double top,
                                       double slowest)
    : p_(p), width_(width), slowest_(slowest) {
  require(p.c1 >= 0 && p.c1 <= 100, "c1", p.c1, "0 to 100");
  require(p.c1 == 0 || (p.c2 > 0 && p.c2 <= 100), "c2", p.c2, "above 0 to 100 m/s");
  require(p.c3 >= 0 && p.c3 <= 1e6, "c3", p.c3, "0 to 1e6 (m/s)^-3");
  require(p.c3 == 0 || (p.c4 > 0 && p.c4 <= 100), "c4", p.c4, "above 0 to 100 m/s");
  require(p.c5 >= 0 && p.c5 <= 1000, "c5", p.c5, "0 to 1000 m/s");
  require(p.c6 >= 0 && p.c6 <= 10, "c6", p.c6, "0 to 10");
  require(p.restitution >= 0 && p.restitution <= 1, "restitution", p.restitution, "0 to 1");
  require(p.conversion >= 0 && p.conversion <= 1, "conversion", p.conversion, "0 to 1");
  require(width > 0 && width <= 1, "bin width", width, "above 0 to 1 m/s");
  require(top >= 4 * width && top <= fastest_launch, "fastest launch", top, "four bins to 50 m/s");
  require(slowest >= 0 && slowest < top, "slowest launch", slowest, "from 0 to below the fastest");
  set_bins(static_cast<std::size_t>(std::ceil(top / width)));
}

void DistributionKernel::set_bins(std::size_t bins) {
  bins_ = bins;
  ejecta_.assign(bins, 0);
  for (std::size_t j = 0; j < bins; ++j) {
    const double low = std::max(slowest_, static_cast<double>(j) * width_);
    const double high = static_cast<double>(j + 1) * width_;
    if (low < high && p_.c3 > 0)
      ejecta_[j] = p_.c3 * p_.c4 * (std::exp(-low / p_.c4) - std::exp(-high / p_.c4));
  }
}

std::vector<double> DistributionKernel::first_spectrum() const {
  std::vector<double> spectrum(p_.c6 > 0 ? 2 * bins_ : bins_);
  for (std::size_t j = 0; j < bins_; ++j) {
    const double v = (static_cast<double>(j) + 0.5) * width_;
    if (v >= slowest_) spectrum[j] = std::exp(-v / 0.5);
  }
  return of_one_grain(std::move(spectrum));
}

void DistributionKernel::launch(const std::vector<double>& spectrum, Launches& launches) const {
  launches.resize(bins_);
  for (std::size_t j = 0; j < bins_; ++j) {
    launches.number[j] = spectrum[j];
    launches.vx[j] = p_.c6 > 0 && spectrum[j] > 0 ? spectrum[bins_ + j] / spectrum[j] : 0;
    launches.vy[j] = (static_cast<double>(j) + 0.5) * width_;
  }
}

void DistributionKernel::splash(const Launches& launches, double least, const Landings& landings,
                                std::vector<double>& spectrum) const {
  static const Normal normal;
  spectrum.assign(p_.c6 > 0 ? 2 * bins_ : bins_, 0);
  double ejecta = 0;
  double ejecta_along = 0;
  for (std::size_t k = 0; k < launches.size(); ++k) {
    const double number = launches.number[k];
    if (!(number > least)) continue;
    const double vx = std::max(0.0, landings.vx[k]);
    const double vy = landings.vy[k];
    const double along = p_.c6 * p_.restitution * (1 - p_.conversion) * vx;
    ejecta += number * (vx * vx + vy * vy);
    ejecta_along += number * (vx * vx + vy * vy) * along;

    if (!(p_.c1 > 0 && vx > 0)) continue;
    const double rebounds = number * p_.c1 * vx / (vx + p_.c5);
    const double peak = p_.conversion * vx + p_.restitution * vy;
    const double first = std::max(slowest_, peak - Normal::range * p_.c2);
    auto j = static_cast<std::size_t>(std::max(0.0, first) / width_);
    double below = normal((std::max(slowest_, static_cast<double>(j) * width_) - peak) / p_.c2);
    for (; j < bins_ && below < 1; ++j) {
      const double next = normal((static_cast<double>(j + 1) * width_ - peak) / p_.c2);
      const double part = rebounds * std::max(0.0, next - below);
      spectrum[j] += part;
      if (p_.c6 > 0) spectrum[bins_ + j] += part * along;
      below = next;
    }
  }
  for (std::size_t j = 0; j < bins_; ++j) {
    spectrum[j] += ejecta * ejecta_[j];
    if (p_.c6 > 0) spectrum[bins_ + j] += ejecta_along * ejecta_[j];
  }
}

double DistributionKernel::number(const std::vector<double>& spectrum) const {
  return std::accumulate(spectrum.begin(), spectrum.begin() + static_cast<std::ptrdiff_t>(bins_), 0.0);
}

double DistributionKernel::cut_off(const std::vector<double>& spectrum) const {
  const auto end = spectrum.begin() + static_cast<std::ptrdiff_t>(bins_);
  return spectrum[bins_ - 1] / *std::max_element(spectrum.begin(), end);
}

bool DistributionKernel::extend(std::vector<double>& spectrum) {
  const std::size_t old = bins_;
  if (static_cast<double>(old) * width_ * 1.5 > fastest_launch) return false;
  set_bins(old + old / 2);
  spectrum.insert(spectrum.begin() + static_cast<std::ptrdiff_t>(old), bins_ - old, 0.0);
  if (p_.c6 > 0) spectrum.resize(2 * bins_);
  return true;
}

}  // namespace aeolian
