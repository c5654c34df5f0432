#include "aeolian_core/saltation/werner_splash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double fastest_launch = 50;  ///< no bed throws grains faster [m/s]

void require(bool allowed, const char* constant, double value, const char* range) {
  if (!allowed)
    throw Error(std::string("Werner's splash: ") + constant + " is " + std::to_string(value) + ", must be " +
                range);
}

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

WernerSplashConstants WernerSplashConstants::thesis_case(int number) {
  WernerSplashConstants c;
  switch (number) {
    case 1:
      c.c3 = 0;
      return c;
    case 2:
      return c;
    case 3:
      c.c1 = 1;
      return c;
    case 4:
      c.c1 = 0;
      c.c4 = 0.8;
      return c;
    case 5:
      c.c3 = 0;
      c.c6 = 1;
      c.restitution = 0.3;
      return c;
    case 6:
      c.c6 = 1;
      c.restitution = 0.3;
      return c;
    default:
      throw Error("Werner's splash: case is " + std::to_string(number) + ", must be 1 to 6");
  }
}

WernerSplash::WernerSplash(const WernerSplashConstants& c, double width, double top, double slowest)
    : c_(c), width_(width), slowest_(slowest) {
  require(c.c1 >= 0 && c.c1 <= 100, "c1", c.c1, "0 to 100");
  require(c.c2 > 0 && c.c2 <= 100, "c2", c.c2, "above 0 to 100 m/s");
  require(c.c3 >= 0 && c.c3 <= 1e6, "c3", c.c3, "0 to 1e6 (m/s)^-3");
  require(c.c4 > 0 && c.c4 <= 100, "c4", c.c4, "above 0 to 100 m/s");
  require(c.c5 > 0 && c.c5 <= 1000, "c5", c.c5, "above 0 to 1000 m/s");
  require(c.c6 >= 0 && c.c6 <= 10, "c6", c.c6, "0 to 10");
  require(c.restitution >= 0 && c.restitution <= 1, "restitution", c.restitution, "0 to 1");
  require(c.conversion >= 0 && c.conversion <= 1, "conversion", c.conversion, "0 to 1");
  require(width > 0 && width <= 1, "bin width", width, "above 0 to 1 m/s");
  require(top >= 4 * width && top <= fastest_launch, "fastest launch", top, "four bins to 50 m/s");
  require(slowest >= 0 && slowest < top, "slowest launch", slowest, "from 0 to below the fastest");
  set_bins(static_cast<std::size_t>(std::ceil(top / width)));
}

void WernerSplash::set_bins(std::size_t bins) {
  bins_ = bins;
  ejecta_.assign(bins, 0);
  for (std::size_t j = 0; j < bins; ++j) {
    const double low = std::max(slowest_, static_cast<double>(j) * width_);
    const double high = static_cast<double>(j + 1) * width_;
    if (low < high) ejecta_[j] = c_.c3 * c_.c4 * (std::exp(-low / c_.c4) - std::exp(-high / c_.c4));
  }
}

std::vector<double> WernerSplash::first_spectrum() const {
  std::vector<double> spectrum(c_.c6 > 0 ? 2 * bins_ : bins_);
  for (std::size_t j = 0; j < bins_; ++j) {
    const double v = (static_cast<double>(j) + 0.5) * width_;
    if (v >= slowest_) spectrum[j] = std::exp(-v / 0.5);
  }
  const double sum = number(spectrum);
  for (double& p : spectrum) p /= sum;
  return spectrum;
}

void WernerSplash::launch(const std::vector<double>& spectrum, Launches& launches) const {
  launches.resize(bins_);
  for (std::size_t j = 0; j < bins_; ++j) {
    launches.number[j] = spectrum[j];
    launches.vx[j] = c_.c6 > 0 && spectrum[j] > 0 ? spectrum[bins_ + j] / spectrum[j] : 0;
    launches.vy[j] = (static_cast<double>(j) + 0.5) * width_;
  }
}

void WernerSplash::splash(const Launches& launches, double least, const Landings& landings,
                          std::vector<double>& spectrum) const {
  static const Normal normal;
  spectrum.assign(c_.c6 > 0 ? 2 * bins_ : bins_, 0);
  double ejecta = 0;
  double ejecta_along = 0;
  for (std::size_t k = 0; k < launches.size(); ++k) {
    const double number = launches.number[k];
    if (!(number > least)) continue;
    const double vx = std::max(0.0, landings.vx[k]);
    const double vy = landings.vy[k];
    const double along = c_.c6 * c_.restitution * (1 - c_.conversion) * vx;
    ejecta += number * (vx * vx + vy * vy);
    ejecta_along += number * (vx * vx + vy * vy) * along;

    const double rebounds = number * c_.c1 * vx / (vx + c_.c5);
    if (!(rebounds > 0)) continue;
    const double peak = c_.conversion * vx + c_.restitution * vy;
    const double first = std::max(slowest_, peak - Normal::range * c_.c2);
    auto j = static_cast<std::size_t>(std::max(0.0, first) / width_);
    double below = normal((std::max(slowest_, static_cast<double>(j) * width_) - peak) / c_.c2);
    for (; j < bins_ && below < 1; ++j) {
      const double next = normal((static_cast<double>(j + 1) * width_ - peak) / c_.c2);
      const double part = rebounds * std::max(0.0, next - below);
      spectrum[j] += part;
      if (c_.c6 > 0) spectrum[bins_ + j] += part * along;
      below = next;
    }
  }
  for (std::size_t j = 0; j < bins_; ++j) {
    spectrum[j] += ejecta * ejecta_[j];
    if (c_.c6 > 0) spectrum[bins_ + j] += ejecta_along * ejecta_[j];
  }
}

double WernerSplash::number(const std::vector<double>& spectrum) const {
  return std::accumulate(spectrum.begin(), spectrum.begin() + static_cast<std::ptrdiff_t>(bins_), 0.0);
}

double WernerSplash::cut_off(const std::vector<double>& spectrum) const {
  const auto end = spectrum.begin() + static_cast<std::ptrdiff_t>(bins_);
  return spectrum[bins_ - 1] / *std::max_element(spectrum.begin(), end);
}

bool WernerSplash::extend(std::vector<double>& spectrum) {
  const std::size_t old = bins_;
  if (static_cast<double>(old) * width_ * 1.5 > fastest_launch) return false;
  set_bins(old + old / 2);
  spectrum.insert(spectrum.begin() + static_cast<std::ptrdiff_t>(old), bins_ - old, 0.0);
  if (c_.c6 > 0) spectrum.resize(2 * bins_);
  return true;
}

}  // namespace aeolian
