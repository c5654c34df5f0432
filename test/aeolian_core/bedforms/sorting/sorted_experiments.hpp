#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "aeolian_core/bedforms/sorting/sorted_growth.hpp"
#include "aeolian_core/bedforms/sorting/sorted_ripple_model.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// Experiments on beds of two sizes that the tests and docs/accuracy/ripples.md have in common: grains of
/// 0.25 and 0.5 mm; fine ones hop 1 cm and 0.1 mm/s of them is set moving, impacts come in at 10 degrees.
struct SortedExperiment {
  static constexpr double hop = 0.01;
  static constexpr double erosion_rate = 1e-4;
  static constexpr double impact_angle = 10 * M_PI / 180;
  static constexpr double unit_time = hop / erosion_rate;
  static constexpr double coarse_diameter = 0.0005;
  static constexpr double coarse_fraction = 0.2;

  static Forcing fine(double direction = 0) {
    Forcing result;
    result.direction = direction;
    result.impact_angle = impact_angle;
    result.ejection_rate = erosion_rate / std::pow(result.grain.effective_diameter(), 3);
    result.reptation_length = hop;
    return result;
  }
  static SortedForcing forcing(double direction = 0) {
    return sorted_forcing(fine(direction), coarse_diameter);
  }
  static SortedRippleParameters parameters(Border border = Border::periodic) {
    SortedRippleParameters result;
    result.ripples.border = border;
    result.ripples.relief_scale = 100;
    result.coarse_diameter = coarse_diameter;
    result.coarse_fraction = coarse_fraction;
    return result;
  }
};

inline std::vector<double> rough_bed(const GridGeometry& g, double deviation, std::uint64_t seed = 1) {
  RandomStream random(seed, 0);
  std::vector<double> h(g.size());
  for (double& z : h) z = deviation * random.normal();
  return h;
}

/// Growth rate (real part) and turning of a small wave of two sizes, by the model and by theory [1/s].
struct WaveGrowth {
  std::complex<double> model, theory;
};

/// The complex amplitude of a wave along the grid's first axis with so many periods.
inline std::complex<double> amplitude_of(const GridGeometry& g, const std::vector<double>& values,
                                         int periods) {
  std::complex<double> total = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      total += values[g.index(x, y)] * std::polar(1.0, -2 * M_PI * periods * (x + 0.5) / g.nx());
  return total * 2.0 / static_cast<double>(values.size());
}

/// A wave of so many fine hops, twenty cells to a hop, on an active layer of so many coarse diameters. The
/// layer's composition takes part as theory says that it does in the faster-growing mode; on a layer of a
/// million diameters it cannot.
inline WaveGrowth growth_of_a_sorted_wave(double hops, double layer_diameters, double fraction,
                                          double step = 1) {
  using E = SortedExperiment;
  SortedRippleParameters p = E::parameters();
  p.coarse_fraction = fraction;
  p.active_layer = layer_diameters;
  p.ripples.step = step;
  const int cells = static_cast<int>(std::lround(hops * 20)) * 2;
  const GridGeometry g(0, 0, E::hop / 20, cells, 1);
  const double k = 4 * M_PI / g.length_x();
  const SortedGrowth theory(E::forcing(), p.ripples, fraction);
  const double layer = p.layers().active;
  const bool fixed = layer_diameters >= 1e6;
  const SortedGrowth::Mode mode =
      fixed ? SortedGrowth::Mode{theory.at_fixed_composition(k), 0.0} : theory.with_active_layer(k, layer);
  const double height = 1e-8;
  std::vector<double> h(g.size());
  std::vector<double> enriched(g.size());
  for (int x = 0; x < cells; ++x) {
    const std::complex<double> wave = height * std::polar(1.0, 4 * M_PI * (x + 0.5) / cells);
    h[g.index(x, 0)] = wave.real();
    enriched[g.index(x, 0)] = layer * (mode.enrichment * wave).real();
  }
  SortedBed bed(g, h, p.layers());
  for (std::size_t i = 0; i < enriched.size(); ++i) bed.coarse[i] += enriched[i];
  const double duration = 0.3 * E::unit_time;
  const std::complex<double> before = amplitude_of(g, bed.height, 2);
  SortedRippleModel(p).advance(bed, E::forcing(), duration);
  return {std::log(amplitude_of(g, bed.height, 2) / before) / duration, mode.rate};
}

/// Coarse fraction of the surface on the highest tenth of a bed less that on its lowest.
inline double crest_enrichment(const SortedBed& bed) {
  std::vector<std::size_t> order(bed.height.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return bed.height[a] < bed.height[b]; });
  const std::size_t tenth = order.size() / 10;
  double difference = 0;
  for (std::size_t i = 0; i < tenth; ++i)
    difference += bed.surface_fraction(order[order.size() - 1 - i]) - bed.surface_fraction(order[i]);
  return difference / static_cast<double>(tenth);
}

/// The coarse fraction of a flat bed's surface that impacts strike and nothing falls on, after `time` [s]: of
/// a well-mixed layer of so many metres that sinks into sand of the bulk's fraction,
/// L df/dt = b K_f (1 - f) - (1 - b) K_c f.
inline double armoured_fraction(double fine_rate, double coarse_rate, double bulk, double layer,
                                double time) {
  const double gain = bulk * fine_rate;
  const double loss = (1 - bulk) * coarse_rate;
  const double steady = gain / (gain + loss);
  return steady + (bulk - steady) * std::exp(-(gain + loss) * time / layer);
}

/// The same bed by the model: grains hop so far that none comes down on it, and none is supplied.
inline SortedBed armoured_bed(double coarse_mobility, double time, double step = 1) {
  using E = SortedExperiment;
  SortedRippleParameters p = E::parameters(Border::open);
  p.ripples.hop_shortening = p.ripples.slope_effect = p.ripples.lateral_spread = 0;
  p.ripples.step = step;
  p.ripples.inflow = Inflow::none;
  SortedForcing forcing = E::forcing();
  forcing.fine.reptation_length = forcing.coarse.reptation_length = 1e6;
  forcing.coarse.ejection_rate =
      coarse_mobility * E::erosion_rate / std::pow(forcing.coarse.grain.effective_diameter(), 3);
  const GridGeometry g(0, 0, 0.002, 16, 4);
  SortedBed bed(g, std::vector<double>(g.size(), 0.0), p.layers());
  SortedRippleModel(p).advance(bed, forcing, time);
  return bed;
}

}  // namespace aeolian
