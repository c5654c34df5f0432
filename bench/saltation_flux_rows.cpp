#include <algorithm>
#include <cmath>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/flux_law.hpp"

namespace aeolian {
namespace {

void height_rows(AccuracyTable& table) {
  table.section("Heights of flights in a wind without grains",
                "Specification 5.8 (fig. 4.22), u* = 160 cm/s, l = 1 cm; cm.");
  const double speeds[] = {0.5, 1, 2, 3, 4, 6, 8, 10};
  const struct {
    double diameter, angle, apex[8];
  } rows[] = {{0.00025, 0, {1.1, 3.5, 9.6, 16.2, 22.8, 36.0, 48.7, 60.8}},
              {0.001, 0, {1.2, 4.7, 16.5, 32.3, 50.6, 91.5, 135, 180}},
              {0.00025, 60, {1.1, 3.7, 10.7, 18.9, 27.6, 45.4, 61.9, 76.0}},
              {0.001, 60, {1.3, 4.8, 17.4, 35.5, 57.8, 112, 174, 238}}};
  WindProfile wind(0.01);
  wind.set_logarithmic(1.6);
  for (const auto& r : rows) {
    SaltatingBed bed = thesis_bed(1);
    bed.grain.diameter = r.diameter;
    const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1);
    for (int i = 0; i < 8; ++i) {
      Landings landings;
      landings.resize(1);
      std::vector<double> stress(WindProfile::levels);
      fly({{speeds[i] * std::tan(r.angle * M_PI / 180)}, {speeds[i]}, {1}}, 0, {wind, drag}, landings,
          stress);
      // Printed to a tenth of a centimetre.
      table.row(fmt::format("d {:g} cm, {:g} degrees, v_oy {:g}", 100 * r.diameter, r.angle, 100 * speeds[i]),
                r.apex[i], 100 * landings.apex[0], std::max(0.01 * r.apex[i], 0.06));
    }
  }
}

}  // namespace

void flux_rows(AccuracyTable& table) {
  table.section("Flux law", "Specification 5.6, [R], g/(cm s).");
  const struct {
    int number;
    std::vector<double> u, flux;
  } rows[] = {
      {1, {33, 40, 50, 60, 75, 100, 125, 150}, {.0251, .0933, .2153, .3667, .651, 1.286, 2.132, 3.20}},
      {3, {40, 60, 75, 100, 125, 150}, {.0675, .3085, .560, 1.124, 1.883, 2.85}}};
  for (const auto& r : rows) {
    const SaltationSolver solver = thesis_solver(r.number);
    const double threshold = *solver.impact_threshold();
    std::vector<double> u, flux;
    for (std::size_t i = 0; i < r.u.size(); ++i) {
      u.push_back(r.u[i] / 100);
      flux.push_back(solver.solve(u.back()).mass_flux());
      table.relative_row(name_of(r.number, r.u[i]) + ", Q", r.flux[i], 10 * flux.back(),
                         (r.u[i] < 120 * threshold ? 4 : 1.5) * percent);
    }
    table.range_row(fmt::format("case {}, slope of ln Q over ln(u*^2 - u*_it^2)", r.number), 0.95, 1.10,
                    excess_stress_exponent(threshold, u, flux));
    const FluxLaw law = FluxLaw::fit(threshold, u, flux);
    double worst = 0, least = 1e9, most = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      worst = std::max(worst, std::abs(law.flux(u[i]) / flux[i] - 1));
      const double c = flux[i] * 9.81 / (1.23 * threshold * (u[i] * u[i] - threshold * threshold));
      least = std::min(least, c);
      most = std::max(most, c);
    }
    table.range_row(fmt::format("case {}, largest error of the three-number law [%]", r.number), 0, 2,
                    100 * worst);
    table.range_row(fmt::format("case {}, least C = Q g / (rho u*_it (u*^2 - u*_it^2))", r.number), 2.5, 12,
                    least);
    table.range_row(fmt::format("case {}, largest C", r.number), 2.5, 12, most);
  }
  height_rows(table);
}

}  // namespace aeolian
