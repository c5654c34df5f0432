#include <algorithm>
#include <cmath>
#include <functional>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/profiles.hpp"

namespace aeolian {
namespace {

void case_1_rows(AccuracyTable& table) {
  table.section("Case 1: trajectories and profiles", "Specification 5.3, [R], cm and s.");
  const SaltationSolver solver = thesis_solver(1);
  const SteadyState s = solver.solve(0.75);
  const SteadyState t = thesis_solver(1, 0.62).solve(0.75);
  const struct {
    const char* name;
    double nominal, compatible, tolerance;
    std::function<double(const SteadyState&)> value;
  } rows[] = {
      {"mean hop height", 2.79, 3.62, 2, [](const auto& x) { return x.mean(x.landings.apex); }},
      {"mean hop length", 35.3, 38.4, 2, [](const auto& x) { return x.mean(x.landings.length); }},
      {"mean v_x of impacts", 329, 327, 1, [](const auto& x) { return x.mean(x.landings.vx); }},
      {"mean v_y of impacts", 59.7, 69.8, 1, [](const auto& x) { return x.mean(x.landings.vy); }},
      {"mean of launch speeds", 85.2, 92.6, 2, [](const auto& x) { return x.mean(x.launches.vy); }},
      {"spread of launch speeds", 39.9, 42.2, 2, [](const auto& x) { return x.spread(x.launches.vy); }}};
  for (const auto& row : rows) {
    table.relative_row(std::string(row.name) + ", u* 75", row.nominal, 100 * row.value(s),
                       row.tolerance * percent);
    table.relative_row(std::string(row.name) + ", u* 75, drag x 0.62", row.compatible, 100 * row.value(t),
                       row.tolerance * percent);
  }
  const double winds[] = {0.35, 0.75, 1.25};
  const double roughness[] = {0.0027, 0.110, 0.42};
  const double speeds[3][6] = {
      {355, 477, 528, 583, 661, 722}, {314, 432, 494, 575, 721, 851}, {265, 378, 450, 561, 786, 1000}};
  const double heights[] = {0.001, 0.005, 0.01, 0.02, 0.05, 0.1};
  for (int i = 0; i < 3; ++i) {
    const SteadyState x = solver.solve(winds[i]);
    for (int j = 0; j < 6; ++j)
      table.relative_row(fmt::format("wind at {:g} cm, u* {:g}", 100 * heights[j], 100 * winds[i]),
                         speeds[i][j], 100 * x.wind.speed(heights[j]), 1 * percent);
    table.relative_row(fmt::format("roughness above the layer, u* {:g}", 100 * winds[i]), roughness[i],
                       100 * x.wind.apparent_roughness(), 5 * percent);
  }
  const SteadyState weak = solver.solve(0.35), strong = solver.solve(1.25);
  table.range_row("growth of the mean v_x of impacts, u* 35 to 125 [%]", 0, 10,
                  100 * (strong.mean(strong.landings.vx) / weak.mean(weak.landings.vx) - 1));
}

/// Height at which two winds cross [cm].
double crossing(const SteadyState& weak, const SteadyState& strong) {
  for (std::size_t i = 9; i < WindProfile::levels; ++i) {
    const double a = strong.wind.speed_at_level(i - 1) - weak.wind.speed_at_level(i - 1);
    const double b = strong.wind.speed_at_level(i) - weak.wind.speed_at_level(i);
    if (a < 0 && b >= 0)
      return 100 * weak.wind.height(i - 1) *
             std::pow(weak.wind.height(i) / weak.wind.height(i - 1), a / (a - b));
  }
  return 0;
}

}  // namespace

void profile_rows(AccuracyTable& table) {
  case_1_rows(table);
  table.section("Table 4.4: heights of the maxima of drag and kinetic energy",
                "Drag x 0.62, cm, over layers of 2 mm, n v_x^3 as kinetic energy; [T] is read from layers of "
                "2 to 5 mm. P3: "
                "drag within 0.8 cm. P4: energy within the larger of 1.2 cm and 50 %, cases 1, 2 and 5.");
  const struct {
    int number;
    double u, flux, energy, drag;
  } rows[] = {{1, 35, 3.0, 3.0, 1.2},  {1, 75, 3.0, 3.0, 1.6},  {1, 125, 3.4, 5.0, 3.0},
              {2, 35, 1.0, 2.0, 0.2},  {2, 75, 1.6, 2.5, 1.0},  {2, 125, 1.8, 4.0, 1.6},
              {3, 50, 1.1, 3.5, 0.2},  {3, 75, 0.6, 2.5, 0.2},  {4, 35, 0.6, 3.4, 0.2},
              {4, 50, 1.4, 3.4, 0.2},  {4, 75, 2.0, 5.0, 0.2},  {5, 50, 0.8, 2.0, 0.6},
              {5, 100, 0.8, 2.0, 0.6}, {5, 150, 1.4, 3.0, 1.2}, {6, 50, 1.6, 2.0, 0.2},
              {6, 100, 1.0, 2.0, 0.2}, {6, 150, 1.0, 4.0, 1.0}};
  bool ordered = true, rising = true, monotone = true;
  double flux2 = 0, drag2 = 0;
  double last_energy = 0, last_drag = 0;
  int last_case = 0;
  for (const auto& r : rows) {
    const SaltationSolver solver = thesis_solver(r.number, 0.62);
    const SteadyState s = solver.solve(r.u / 100);
    const SaltationProfiles p = profiles(s, solver.bed());
    const double layer = 0.002, slack = 0.2;
    const double drag = 100 * p.peak(p.drag, layer), energy = 100 * p.peak(p.cubed_flux, layer);
    const double flux = 100 * p.peak(p.number_flux, layer);
    table.row(name_of(r.number, r.u) + ", drag", r.drag, drag, 0.8);
    if (r.number == 1 || r.number == 2 || r.number == 5)
      table.row(name_of(r.number, r.u) + ", kinetic energy", r.energy, energy, std::max(1.2, 0.5 * r.energy));
    else
      table.remark(name_of(r.number, r.u) + ", kinetic energy", r.energy, energy);
    table.remark(name_of(r.number, r.u) + ", flux", r.flux, flux);
    ordered = ordered && (r.number == 6 || drag <= flux + slack) &&
              (r.number == 6 || flux <= energy + slack) && drag <= energy + slack;
    if (r.number == last_case) rising = rising && energy >= last_energy - slack && drag >= last_drag - slack;
    last_case = r.number;
    last_energy = energy;
    last_drag = drag;
    if (r.number == 2 && r.u == 75) flux2 = flux, drag2 = drag;
    if (r.number == 3 && r.u == 75)
      table.statement("P6 flux and drag peak lower in case 3 than in 2",
                      fmt::format("{:.1f} and {:.1f} cm", flux, drag), flux < flux2 && drag <= drag2);
    if (r.number >= 2 && r.number <= 4) {
      const DistributionKernel fine(DistributionSplash::thesis_case(r.number), 0.01);
      const SteadyState smooth = SaltationSolver(solver.bed(), fine).solve(r.u / 100);
      // Layers thicker than the distance of neighbouring summits.
      const SaltationProfiles q = profiles(smooth, solver.bed(), 0.01);
      for (std::size_t i = 0; i + 1 < std::min<std::size_t>(20, q.height.size()); ++i)
        monotone = monotone && q.number_density[i + 1] < q.number_density[i];
    }
  }
  table.statement("P1 drag peaks below flux, flux below energy (case 6: drag below energy)",
                  ordered ? "all" : "not all", ordered);
  table.statement("P2 peaks of energy and drag do not fall as u* rises (one layer of slack)",
                  rising ? "all" : "not all", rising);
  table.statement("P5 number density falls with height, cases 2 to 4 (layers of 1 cm)",
                  monotone ? "all" : "not all", monotone);

  table.section("Focus of the winds",
                "Specification 5.5: crossing of the weakest and the strongest wind of table 4.3, cm.");
  const double first[] = {35, 35, 35, 35, 50, 50}, last[] = {125, 125, 125, 75, 150, 150};
  const double nominal[] = {2.46, 2.26, 2.02, 3.96, 1.75, 1.91};
  for (int number = 1; number <= 6; ++number) {
    const SaltationSolver solver = thesis_solver(number);
    table.relative_row(fmt::format("case {}", number), nominal[number - 1],
                       crossing(solver.solve(first[number - 1] / 100), solver.solve(last[number - 1] / 100)),
                       3 * percent);
  }
}

}  // namespace aeolian
