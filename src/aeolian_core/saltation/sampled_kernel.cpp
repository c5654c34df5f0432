#include "aeolian_core/saltation/sampled_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double fastest_launch = 100;       ///< [m/s]
constexpr double slowest_impact = 1.0 / 16;  ///< [m/s]; slower ones do as these
constexpr double knots_per_octave = 3;
constexpr std::array<double, 14> angles{1 * degree,  4 * degree,  7 * degree,  10 * degree, 13 * degree,
                                        16 * degree, 20 * degree, 25 * degree, 32 * degree, 41 * degree,
                                        52 * degree, 64 * degree, 77 * degree, 90 * degree};

/// Place between two knots: the lower one and the weight of the upper.
struct Place {
  std::size_t knot;
  double part;
};

Place place_of_angle(double angle) {
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  const auto knot = static_cast<std::size_t>(above - angles.begin()) - 1;
  return {knot, std::clamp((angle - angles[knot]) / (angles[knot + 1] - angles[knot]), 0.0, 1.0)};
}

}  // namespace

SampledKernel::SampledKernel(std::shared_ptr<const Splash> splash, std::string name, const Grain& grain,
                             const Atmosphere& atmosphere, const SplashSampling& sampling)
    : splash_(std::move(splash)), name_(std::move(name)), sampling_(sampling) {
  check(grain);
  check(atmosphere);
  if (sampling.events < 1 || sampling.events > 1000000)
    throw Error("sampled splash: events are " + std::to_string(sampling.events) + ", must be 1 to 1000000");
  if (sampling.speeds_per_octave < 1 || sampling.speeds_per_octave > 32)
    throw Error("sampled splash: speeds in an octave are " + std::to_string(sampling.speeds_per_octave) +
                ", must be 1 to 32");
  if (sampling.elevations < 2 || sampling.elevations > 360)
    throw Error("sampled splash: elevations are " + std::to_string(sampling.elevations) +
                ", must be 2 to 360");
  if (!(sampling.slowest >= 0.01 && sampling.slowest <= 10))
    throw Error("sampled splash: the slowest launch is " + std::to_string(sampling.slowest) +
                " sqrt(g d), must be 0.01 to 10");
  slowest_ = sampling.slowest * std::sqrt(atmosphere.gravity * grain.diameter);
  speeds_ =
      static_cast<std::size_t>(std::ceil(sampling.speeds_per_octave * std::log2(400 / sampling.slowest)));
  elevations_ = static_cast<std::size_t>(sampling.elevations);
  draw();
}

void SampledKernel::draw() {
  const double octave = sampling_.speeds_per_octave;
  const double step = M_PI / static_cast<double>(elevations_);
  classes_.resize(speeds_ * elevations_);
  for (std::size_t i = 0; i < speeds_; ++i)
    for (std::size_t a = 0; a < elevations_; ++a) {
      const double speed = slowest_ * std::exp2((static_cast<double>(i) + 0.5) / octave);
      classes_.vx[i * elevations_ + a] = speed * std::cos((static_cast<double>(a) + 0.5) * step);
      classes_.vy[i * elevations_ + a] = speed * std::sin((static_cast<double>(a) + 0.5) * step);
    }

  const double fastest = slowest_ * std::exp2(static_cast<double>(speeds_) / octave);
  knots_ =
      static_cast<std::size_t>(std::ceil(knots_per_octave * std::log2(2 * fastest / slowest_impact))) + 1;
  auto table = std::make_shared<std::vector<double>>(knots_ * angles.size() * classes_.size(), 0.0);
  SplashEvent event;
  for (std::size_t k = 0; k < knots_ * angles.size(); ++k) {
    const std::size_t knot = k / angles.size();
    const Impact impact{slowest_impact * std::exp2(static_cast<double>(knot) / knots_per_octave),
                        angles[k % angles.size()]};
    RandomStream random(sampling_.seed, k);
    double* spectrum = table->data() + k * classes_.size();
    const auto count = [&](const LeavingGrain& grain) {
      if (!(grain.velocity.z() >= slowest_)) return;
      const double speed = std::hypot(grain.velocity.x(), grain.velocity.z());
      const auto i = std::min(static_cast<std::size_t>(octave * std::log2(speed / slowest_)), speeds_ - 1);
      const double elevation = std::atan2(grain.velocity.z(), grain.velocity.x());
      const auto a = std::min(static_cast<std::size_t>(elevation / step), elevations_ - 1);
      spectrum[i * elevations_ + a] += 1.0 / sampling_.events;
    };
    for (int n = 0; n < sampling_.events; ++n) {
      splash_->sample(impact, random, event);
      if (event.rebound) count(*event.rebound);
      for (const LeavingGrain& grain : event.ejecta) count(grain);
    }
  }
  table_ = std::move(table);
}

std::vector<double> SampledKernel::first_spectrum() const {
  std::vector<double> spectrum(classes_.size());
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    if (classes_.vx[k] > 0)
      spectrum[k] = std::exp(-std::hypot(classes_.vx[k], classes_.vy[k]) / (70 * slowest_));
  return of_one_grain(std::move(spectrum));
}

void SampledKernel::launch(const std::vector<double>& spectrum, Launches& launches) const {
  launches.vx = classes_.vx;
  launches.vy = classes_.vy;
  launches.number = spectrum;
}

void SampledKernel::splash(const Launches& launches, double least, const Landings& landings,
                           std::vector<double>& spectrum) const {
  std::vector<double> impacts(knots_ * angles.size());
  for (std::size_t k = 0; k < launches.size(); ++k) {
    const double number = launches.number[k];
    if (!(number > least)) continue;
    const double speed = std::hypot(landings.vx[k], landings.vy[k]);
    const double at = knots_per_octave * std::log2(std::max(speed / slowest_impact, 1.0));
    const auto v = std::min(static_cast<std::size_t>(at), knots_ - 2);
    const double part = std::min(1.0, at - static_cast<double>(v));
    const Place angle = place_of_angle(std::atan2(landings.vy[k], std::max(0.0, landings.vx[k])));
    double* place = &impacts[v * angles.size() + angle.knot];
    place[0] += number * (1 - part) * (1 - angle.part);
    place[1] += number * (1 - part) * angle.part;
    place[angles.size()] += number * part * (1 - angle.part);
    place[angles.size() + 1] += number * part * angle.part;
  }
  spectrum.assign(classes_.size(), 0);
  for (std::size_t n = 0; n < impacts.size(); ++n) {
    if (!(impacts[n] > 0)) continue;
    const double* leaving = table_->data() + n * classes_.size();
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] += impacts[n] * leaving[k];
  }
}

double SampledKernel::number(const std::vector<double>& spectrum) const {
  return std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
}

double SampledKernel::cut_off(const std::vector<double>& spectrum) const {
  const auto end = static_cast<std::ptrdiff_t>(elevations_);
  return *std::max_element(spectrum.end() - end, spectrum.end()) /
         *std::max_element(spectrum.begin(), spectrum.end());
}

bool SampledKernel::extend(std::vector<double>& spectrum) {
  if (slowest_ * std::exp2(static_cast<double>(speeds_) / sampling_.speeds_per_octave) * 2 > fastest_launch)
    return false;
  speeds_ += static_cast<std::size_t>(sampling_.speeds_per_octave);
  draw();
  spectrum.resize(classes_.size());
  return true;
}

}  // namespace aeolian
