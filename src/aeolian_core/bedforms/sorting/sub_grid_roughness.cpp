#include "aeolian_core/bedforms/sorting/sub_grid_roughness.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/bedforms/sorting/sorted_growth.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// dv/dt = a + b v + c v^2 with a > 0 > c, which tends to its positive root.
class Riccati {
 public:
  Riccati(double a, double b, double c) {
    pace_ = std::sqrt(b * b - 4 * a * c);
    // The root whose terms have one sign directly, the other by their product a / c.
    const double q = -0.5 * (b + std::copysign(pace_, b));
    upper_ = std::max(q / c, a / q);
    lower_ = std::min(q / c, a / q);
  }
  double after(double v, double time) const {
    const double u = distance(v) * std::exp(-pace_ * time);
    return (upper_ + u * lower_) / (1 + u);
  }
  double time_to(double target, double from) const {
    return std::log(distance(from) / distance(target)) / pace_;
  }

 private:
  double distance(double v) const { return (upper_ - v) / (v - lower_); }
  double pace_, upper_, lower_;
};

/// dv/dt = 2 s v (1 - v / most).
double logistic(double v, double most, double rate, double time) {
  return most / (1 + (most / v - 1) * std::exp(-2 * rate * time));
}

/// The laws of a map's cells, by their composition in steps far finer than anyone knows it.
class CellLaws {
 public:
  CellLaws(const HeightMap& map, const SortedForcing& forcing, const RippleParameters& ripples,
           const RoughnessParameters& parameters)
      : forcing_(forcing),
        ripples_(ripples),
        parameters_(parameters),
        cell_(map.geometry().cell()),
        fraction_(map.has(layer::coarse_fraction) ? &map.layer(layer::coarse_fraction) : nullptr),
        laws_(steps + 1) {}

  const RoughnessLaw& of(std::size_t cell) {
    const double told = fraction_ ? static_cast<double>((*fraction_)[cell]) : 0;
    const double part = std::isfinite(told) ? std::clamp(told, 0.0, 1.0) : 0;
    const auto step = static_cast<std::size_t>(std::lround(steps * part));
    RoughnessLaw& law = laws_[step];
    if (law.grain == 0)
      law = roughness_law(forcing_, static_cast<double>(step) / steps, cell_, ripples_, parameters_);
    return law;
  }

 private:
  static constexpr int steps = 1000;
  const SortedForcing& forcing_;
  const RippleParameters& ripples_;
  const RoughnessParameters& parameters_;
  double cell_;
  const HeightMap::Layer* fraction_;
  std::vector<RoughnessLaw> laws_;
};

}  // namespace

double RoughnessLaw::after(double roughness, double duration) const {
  const double v = roughness * roughness;
  const double mottled = grain * grain;
  if (!(mottling > 0) || duration == 0) return roughness;
  if (!(growth > 0)) return std::sqrt(mottled + (v - mottled) * std::exp(-2 * mottling * duration / mottled));
  const double most = ripples * ripples;
  if (v >= mottled) return std::sqrt(logistic(v, most, growth, duration));
  const Riccati rise(2 * mottling, 2 * growth - 2 * mottling / mottled, -2 * growth / most);
  const double time = rise.time_to(mottled, v);
  if (duration <= time) return std::sqrt(rise.after(v, duration));
  return std::sqrt(logistic(mottled, most, growth, duration - time));
}

double RoughnessLaw::steady() const { return growth > 0 ? ripples : grain; }

RoughnessLaw roughness_law(const SortedForcing& forcing, double coarse_fraction, double cell,
                           const RippleParameters& ripples, const RoughnessParameters& parameters) {
  const auto mean = [&](double fine, double coarse) { return fine + coarse_fraction * (coarse - fine); };
  RoughnessLaw law;
  law.grain = mean(forcing.fine.grain.effective_diameter(), forcing.coarse.grain.effective_diameter());
  law.mottling = law.grain * mean(forcing.fine.erosion_rate(), forcing.coarse.erosion_rate());
  if (law.mottling == 0) return law;
  const SortedGrowth::Fastest fastest = SortedGrowth(forcing, ripples, coarse_fraction).fastest();
  law.wavelength = fastest.wavelength;
  const double height = fastest.wavelength / parameters.index;
  const double mature = height / (2 * std::sqrt(2.0));
  if (fastest.rate <= 0 || fastest.wavelength >= parameters.cells_per_ripple * cell || mature <= law.grain)
    return law;
  law.growth = fastest.rate;
  law.ripples = mature;
  return law;
}

void advance_roughness(HeightMap& map, const SortedForcing& forcing, double duration,
                       const RippleParameters& ripples, const RoughnessParameters& parameters) {
  check(forcing, duration);
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (!map.has(layer::roughness)) map.add(layer::roughness);
  HeightMap::Layer& roughness = map.layer(layer::roughness);
  CellLaws laws(map, forcing, ripples, parameters);
  for (std::size_t i = 0; i < roughness.size(); ++i) {
    if (!std::isfinite(elevation[i])) {
      roughness[i] = HeightMap::unknown;
      continue;
    }
    const double before = std::isfinite(roughness[i]) ? static_cast<double>(roughness[i]) : 0;
    if (before < 0)
      throw Error("roughness: cell " + std::to_string(i) + " is " + std::to_string(before) +
                  " m, must be zero or more");
    roughness[i] = static_cast<float>(laws.of(i).after(before, duration));
  }
}

double aerodynamic_roughness(double roughness, const RoughnessLaw& law) {
  const double grains = std::min(roughness, law.grain) / 30;
  if (roughness <= law.grain || !(law.wavelength > 0)) return grains;
  const double height_squared = 8 * (roughness * roughness - law.grain * law.grain);
  return grains + 0.5 * height_squared / law.wavelength;
}

double aerodynamic_roughness(const HeightMap& map, const SortedForcing& forcing,
                             const RippleParameters& ripples, const RoughnessParameters& parameters) {
  check(forcing, 0);
  const HeightMap::Layer& roughness = map.layer(layer::roughness);
  CellLaws laws(map, forcing, ripples, parameters);
  double sum = 0;
  std::size_t known = 0;
  for (std::size_t i = 0; i < roughness.size(); ++i) {
    const auto r = static_cast<double>(roughness[i]);
    if (!(r > 0)) continue;
    sum += std::log(aerodynamic_roughness(r, laws.of(i)));
    ++known;
  }
  if (known == 0) throw Error("roughness: no cell of the map has a roughness above zero");
  return std::exp(sum / static_cast<double>(known));
}

}  // namespace aeolian
