#include "aeolian_core/bedforms/sorting/sorted_growth.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/height_map/impact_angles.hpp"
#include "aeolian_core/surface/golden_section.hpp"

namespace aeolian {

SortedGrowth::SortedGrowth(const SortedForcing& forcing, const RippleParameters& ripples,
                           double coarse_fraction)
    : contrast_(
          1 / ImpactAngles(forcing.fine.impact_angle, forcing.fine.impact_angle_spread).effective_tangent()),
      shortening_(ripples.hop_shortening),
      slope_effect_(ripples.slope_effect),
      fine_{1 - coarse_fraction, forcing.fine.erosion_rate(), forcing.fine.reptation_length},
      coarse_{coarse_fraction, forcing.coarse.erosion_rate(), forcing.coarse.reptation_length} {}

/// Hops of exponential length: 1 / (1 + i k a) of what is set moving comes down in its place.
std::complex<double> SortedGrowth::displaced(const Size& size, double wave_number) {
  const std::complex<double> ika(0, wave_number * size.hop);
  return -ika / (1.0 + ika);
}

/// Rate at which a size's grains raise a wave of height, per fraction of the surface: more are struck on
/// slopes that face the wind, and hops end early uphill.
std::complex<double> SortedGrowth::by_height(const Size& size, double k) const {
  const std::complex<double> ik(0, k);
  return size.rate *
         (displaced(size, k) * contrast_ * ik - shortening_ * size.hop * k * k / (1.0 + ik * size.hop));
}

/// Rate at which slopes level a wave.
double SortedGrowth::levelled(double k) const {
  return slope_effect_ * k * k *
         (fine_.fraction * fine_.rate * fine_.hop + coarse_.fraction * coarse_.rate * coarse_.hop);
}

std::complex<double> SortedGrowth::at_fixed_composition(double k) const {
  return fine_.fraction * by_height(fine_, k) + coarse_.fraction * by_height(coarse_, k) - levelled(k);
}

SortedGrowth::Mode SortedGrowth::with_active_layer(double k, double layer) const {
  // d(h, f)/dt = M (h, f); the slope flux carries the mean composition, as does what passes to strata.
  const std::complex<double> hh = at_fixed_composition(k);
  const std::complex<double> hf = coarse_.rate * displaced(coarse_, k) - fine_.rate * displaced(fine_, k);
  const std::complex<double> coarse_h =
      coarse_.fraction * by_height(coarse_, k) - coarse_.fraction * levelled(k);
  const std::complex<double> coarse_f = coarse_.rate * displaced(coarse_, k);
  const std::complex<double> fh = (coarse_h - coarse_.fraction * hh) / layer;
  const std::complex<double> ff = (coarse_f - coarse_.fraction * hf) / layer;
  const std::complex<double> middle = 0.5 * (hh + ff);
  const std::complex<double> root = std::sqrt(0.25 * (hh - ff) * (hh - ff) + hf * fh);
  const std::complex<double> rate =
      (middle + root).real() > (middle - root).real() ? middle + root : middle - root;
  return {rate, fh / (rate - ff)};
}

SortedGrowth::Fastest SortedGrowth::fastest() const {
  const double longest_hop = std::max(fine_.hop, coarse_.hop);
  if (!(longest_hop > 0)) return {};
  // Several sizes may have several maxima: the highest of many waves, then between its neighbours.
  const auto rate = [&](double log_wave_number) {
    return at_fixed_composition(std::exp(log_wave_number)).real();
  };
  constexpr double step = 0.05;
  const double first = std::log(1e-3 / longest_hop);
  double best = first;
  for (double x = first; x < std::log(1e3 / longest_hop); x += step)
    if (rate(x) > rate(best)) best = x;
  const double peak = minimum_between(best - step, best + step, 1e-6, [&](double x) { return -rate(x); });
  return {2 * M_PI / std::exp(peak), rate(peak)};
}

}  // namespace aeolian
