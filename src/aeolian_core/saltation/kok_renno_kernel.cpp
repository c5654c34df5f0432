#include "aeolian_core/saltation/kok_renno_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr double fastest_launch = 100;  ///< [m/s]
constexpr int knots_per_octave = 16;
constexpr double slowest_impact = 1.0 / 64;                            ///< [m/s], below: in proportion
constexpr std::size_t all_knots = std::size_t{16} * knots_per_octave;  ///< up to 1000 m/s

constexpr Require require{"Kok & Renno's splash"};

double normal_below(double z) { return 0.5 * std::erfc(-z / M_SQRT2); }

/// Part of an exponential distribution of this mean that lies between.
double exponential_between(double low, double high, double mean) {
  return high > low ? std::exp(-low / mean) - std::exp(-high / mean) : 0;
}

}  // namespace

KokRennoKernel::KokRennoKernel(const Grain& grain, const Atmosphere& atmosphere,
                               const KokRennoConstants& constants, int speeds_per_octave, int angles)
    : c_(constants),
      scale_(std::sqrt(atmosphere.gravity *
                       (constants.bed_diameter > 0 ? constants.bed_diameter : grain.diameter))),
      slowest_(constants.slowest * std::sqrt(atmosphere.gravity * grain.diameter)),
      speeds_per_octave_(speeds_per_octave),
      angles_(static_cast<std::size_t>(angles)) {
  check(grain);
  check(atmosphere);
  const auto& c = constants;
  require(c.rebound_probability >= 0 && c.rebound_probability <= 1, "rebound probability",
          c.rebound_probability, "0 to 1");
  require(c.rebound_speed > 0 && c.rebound_speed <= 100, "rebound speed", c.rebound_speed,
          "above 0 to 100 m/s");
  require(c.energy_kept > 0 && c.energy_kept < 1, "energy kept", c.energy_kept, "between 0 and 1");
  require(c.energy_spread > 0 && c.energy_spread < 1, "energy spread", c.energy_spread, "between 0 and 1");
  require(c.rebound_angle > 0 && c.rebound_angle <= M_PI, "rebound angle", c.rebound_angle, "above 0 to pi");
  require(c.ejecta_coefficient > 0 && c.ejecta_coefficient <= 1, "ejecta coefficient", c.ejecta_coefficient,
          "above 0 to 1");
  require(c.ejecta_momentum > 0 && c.ejecta_momentum <= 1, "ejecta momentum", c.ejecta_momentum,
          "above 0 to 1");
  require(c.ejecta_onset >= 0 && c.ejecta_onset <= 1e4, "ejecta onset", c.ejecta_onset, "0 to 10000");
  require(c.ejecta_angle > 0 && c.ejecta_angle <= M_PI, "ejecta angle", c.ejecta_angle, "above 0 to pi");
  require(c.steepest > 0.5 && c.steepest <= M_PI, "steepest angle", c.steepest, "0.5 to pi");
  require(c.slowest >= 0.01 && c.slowest <= 10, "slowest launch", c.slowest, "0.01 to 10 sqrt(g d)");
  require(c.bed_diameter >= 0 && c.bed_diameter <= 1, "bed diameter", c.bed_diameter, "0 to 1 m");
  if (speeds_per_octave < 1 || speeds_per_octave > 32 || angles < 2 || angles > 256)
    throw Error("Kok & Renno's splash: bins of speed and angle are " + std::to_string(speeds_per_octave) +
                " and " + std::to_string(angles) + ", must be 1 to 32 in an octave and 2 to 256");
  set_bins(static_cast<std::size_t>(std::ceil(speeds_per_octave * std::log2(200 / c.slowest))));
}

void KokRennoKernel::set_bins(std::size_t bins) {
  bins_ = bins;
  edge_.resize(bins + 1);
  for (std::size_t i = 0; i <= bins; ++i)
    edge_[i] = slowest_ * std::exp2(static_cast<double>(i) / speeds_per_octave_);
  classes_.resize(bins * angles_);
  rebound_part_.assign(classes_.size(), 0);
  ejecta_part_.assign(classes_.size(), 0);
  std::vector<double> rebounds_escape(bins), ejecta_escape(bins);
  const double rebound_all = exponential_between(0, c_.steepest, c_.rebound_angle);
  const double ejecta_all = exponential_between(0, c_.steepest, c_.ejecta_angle);
  for (std::size_t i = 0; i < bins; ++i) {
    const double speed = std::sqrt(edge_[i] * edge_[i + 1]);
    const double flattest = std::asin(slowest_ / speed);
    const double step = (std::min(c_.steepest, M_PI - flattest) - flattest) / static_cast<double>(angles_);
    for (std::size_t a = 0; a < angles_; ++a) {
      const double low = flattest + static_cast<double>(a) * step;
      const std::size_t k = i * angles_ + a;
      classes_.vx[k] = speed * std::cos(low + 0.5 * step);
      classes_.vy[k] = speed * std::sin(low + 0.5 * step);
      rebound_part_[k] = exponential_between(low, low + step, c_.rebound_angle) / rebound_all;
      ejecta_part_[k] = exponential_between(low, low + step, c_.ejecta_angle) / ejecta_all;
      rebounds_escape[i] += rebound_part_[k];
      ejecta_escape[i] += ejecta_part_[k];
    }
    for (std::size_t k = i * angles_; k < (i + 1) * angles_; ++k) {
      rebound_part_[k] /= rebounds_escape[i];
      ejecta_part_[k] /= ejecta_escape[i];
    }
  }

  table_.assign(all_knots * 2 * bins, 0);
  const double least = 0.01, most = 0.999;
  for (std::size_t n = 0; n < all_knots; ++n) {
    const double v = slowest_impact * std::exp2(static_cast<double>(n) / knots_per_octave);
    double* rebounds = &table_[n * 2 * bins];
    double* ejecta = rebounds + bins;
    const double probability = c_.rebound_probability * (1 - std::exp(-v / c_.rebound_speed));
    const double number = c_.ejecta_coefficient * v / scale_;
    double mean = c_.ejecta_momentum / c_.ejecta_coefficient * scale_;
    if (c_.ejecta_onset > 0) mean *= 1 - std::exp(-v / (c_.ejecta_onset * scale_));
    const auto kept_below = [&](double speed) {
      const double part = speed * speed / (v * v);
      if (part < least) return 0.0;
      if (part >= most) return 1.0;
      return normal_below((part - c_.energy_kept) / c_.energy_spread);
    };
    for (std::size_t i = 0; i < bins; ++i) {
      rebounds[i] = probability * rebounds_escape[i] * (kept_below(edge_[i + 1]) - kept_below(edge_[i]));
      ejecta[i] = number * ejecta_escape[i] * exponential_between(edge_[i], edge_[i + 1], mean);
    }
  }
}

std::vector<double> KokRennoKernel::first_spectrum() const {
  std::vector<double> spectrum(2 * bins_);
  for (std::size_t i = 0; i < bins_; ++i)
    spectrum[i] = spectrum[bins_ + i] = exponential_between(edge_[i], edge_[i + 1], 10 * scale_);
  return of_one_grain(std::move(spectrum));
}

void KokRennoKernel::launch(const std::vector<double>& spectrum, Launches& launches) const {
  launches.vx = classes_.vx;
  launches.vy = classes_.vy;
  launches.number.resize(classes_.size());
  for (std::size_t i = 0; i < bins_; ++i)
    for (std::size_t k = i * angles_; k < (i + 1) * angles_; ++k)
      launches.number[k] = spectrum[i] * rebound_part_[k] + spectrum[bins_ + i] * ejecta_part_[k];
}

std::size_t KokRennoKernel::knots() { return all_knots; }

void KokRennoKernel::count_impacts(const Launches& launches, std::size_t first, std::size_t last,
                                   double least, const Landings& landings, std::vector<double>& impacts) {
  for (std::size_t k = first; k < last; ++k) {
    if (!(launches.number[k] > least)) continue;
    const double v = std::hypot(landings.vx[k], landings.vy[k]);
    const double at = knots_per_octave * std::log2(std::max(v, slowest_impact) / slowest_impact);
    const auto n = std::min(static_cast<std::size_t>(at), all_knots - 2);
    const double part = std::min(1.0, at - static_cast<double>(n));
    impacts[n] += launches.number[k] * (1 - part);
    impacts[n + 1] += launches.number[k] * part;
  }
}

void KokRennoKernel::splash(const std::vector<double>& rebounding, const std::vector<double>& ejecting,
                            std::vector<double>& spectrum) const {
  spectrum.assign(2 * bins_, 0);
  for (std::size_t n = 0; n < all_knots; ++n) {
    const double* rebounds = &table_[n * 2 * bins_];
    const double* ejecta = rebounds + bins_;
    if (!(rebounding[n] > 0 || ejecting[n] > 0)) continue;
    for (std::size_t i = 0; i < bins_; ++i) {
      spectrum[i] += rebounding[n] * rebounds[i];
      spectrum[bins_ + i] += ejecting[n] * ejecta[i];
    }
  }
}

void KokRennoKernel::splash(const Launches& launches, double least, const Landings& landings,
                            std::vector<double>& spectrum) const {
  std::vector<double> impacts(all_knots);
  count_impacts(launches, 0, launches.size(), least, landings, impacts);
  splash(impacts, impacts, spectrum);
}

double KokRennoKernel::number(const std::vector<double>& spectrum) const {
  return std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
}

double KokRennoKernel::cut_off(const std::vector<double>& spectrum) const {
  return std::max(spectrum[bins_ - 1], spectrum[2 * bins_ - 1]) /
         *std::max_element(spectrum.begin(), spectrum.end());
}

bool KokRennoKernel::extend(std::vector<double>& spectrum) {
  const std::size_t old = bins_;
  if (edge_.back() * 1.5 > fastest_launch) return false;
  set_bins(old + static_cast<std::size_t>(speeds_per_octave_));
  spectrum.insert(spectrum.begin() + static_cast<std::ptrdiff_t>(old), bins_ - old, 0.0);
  spectrum.resize(2 * bins_);
  return true;
}

double KokRennoKernel::rebound_share(const std::vector<double>& spectrum) const {
  return std::accumulate(spectrum.begin(), spectrum.begin() + static_cast<std::ptrdiff_t>(bins_), 0.0) /
         number(spectrum);
}

}  // namespace aeolian
