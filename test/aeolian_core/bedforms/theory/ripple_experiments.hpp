#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "aeolian_core/bedforms/height_map/exposure.hpp"
#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/theory/ripple_kinematics.hpp"

namespace aeolian {

/// Experiments on beds that the tests and docs/accuracy/ripples.md have in common. The reptation length is 1
/// cm, K0 = 0.1 mm/s and the impacts come in at 10 degrees.
struct RippleExperiment {
  static constexpr double hop = 0.01;
  static constexpr double erosion_rate = 1e-4;
  static constexpr double impact_angle = 10 * M_PI / 180;
  static constexpr double unit_time = hop / erosion_rate;

  static Forcing forcing() {
    Forcing result;
    result.impact_angle = impact_angle;
    const double side = result.grain.effective_diameter();
    result.ejection_rate = erosion_rate / (side * side * side);
    result.reptation_length = hop;
    return result;
  }
};

/// One ripple alone in a periodic row grows until it keeps its shape; its heights over the flux that moves it
/// (eq. 5.5). The flux is read off the change of the bed.
inline MovingShape translation_of_a_grown_ripple(int hops_per_wavelength) {
  using E = RippleExperiment;
  RippleParameters parameters;
  parameters.border = Border::periodic;
  parameters.relief_scale = 100;
  RippleModel model(parameters);
  const GridGeometry g(0, 0, E::hop / 10, 10 * hops_per_wavelength, 1);
  std::vector<double> h;
  for (int x = 0; x < g.nx(); ++x) h.push_back(1e-4 * std::cos(2 * M_PI * g.x(x) / g.length_x()));
  model.advance(g, h, E::forcing(), 60 * E::unit_time);
  const std::vector<double> before = h;
  constexpr double duration = 0.002 * E::unit_time;
  model.advance(g, h, E::forcing(), duration);
  return fit_translation(before, flux_between(before, h, g.cell(), duration));
}

/// Growth rate [1/s] of a small wave whose length is so many reptation lengths, where each grain struck, as
/// often as the bed is exposed, hops the reptation length exactly.
inline double growth_rate_of_a_wave(double hops) {
  using E = RippleExperiment;
  constexpr int cells_per_hop = 20;
  const double cell = E::hop / cells_per_hop;
  const auto cells = static_cast<std::size_t>(std::lround(hops * cells_per_hop));
  const double k = 2 * M_PI / (static_cast<double>(cells) * cell);
  constexpr double amplitude = 1e-7;
  std::vector<double> h(cells);
  for (std::size_t i = 0; i < cells; ++i) h[i] = amplitude * std::cos(k * cell * static_cast<double>(i));
  std::vector<double> exposure(cells);
  exposure_periodic(h.data(), cells, cell * std::tan(E::impact_angle), exposure.data());
  // Cell i-1 to i is struck exposure[i] times; half of it is counted to either cell.
  std::complex<double> change = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    const auto erosion = [&](std::size_t at) {
      return E::erosion_rate * (exposure[at % cells] + exposure[(at + 1) % cells]) / 2;
    };
    const double rate = erosion(i + cells - cells_per_hop) - erosion(i);
    change += rate * std::polar(1.0, -k * cell * static_cast<double>(i));
  }
  return change.real() * 2 / static_cast<double>(cells) / amplitude;
}

}  // namespace aeolian
