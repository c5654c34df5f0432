// The accuracy of saltation as a Markdown page: docs/accuracy/saltation.md is what this prints.
//
//     ./twin bench saltation_accuracy

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <numeric>

#include "accuracy_table.hpp"

#include "aeolian_core/grains/coarse_sand.hpp"
#include "aeolian_core/grains/composed_splash.hpp"
#include "aeolian_core/grains/kok_renno.hpp"
#include "aeolian_core/saltation/conveyor.hpp"
#include "aeolian_core/saltation/distribution_kernel.hpp"
#include "aeolian_core/saltation/flux_response.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/literal_iteration.hpp"
#include "aeolian_core/saltation/profiles.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"
#include "aeolian_core/saltation/transient_saltation.hpp"

namespace aeolian {
namespace {

/// Sand and air of the thesis; all tables of this page are in its units, cm, g and s.
SaltatingBed thesis_bed(double drag_scale) {
  SaltatingBed bed;
  bed.grain.diameter = 0.00025;
  bed.grain.density = 2600;
  bed.atmosphere = {1.23, 1.46e-5, 9.81};
  bed.drag_law = DragLaw::sphere;
  bed.drag_scale = drag_scale;
  return bed;
}

SaltationSolver thesis_solver(int number, double drag_scale = 1) {
  return {thesis_bed(drag_scale), DistributionKernel(DistributionSplash::thesis_case(number))};
}

/// Eq. 4.34 on a grid that ends where the reference solver's did, whatever that cuts off.
class EndedKernel : public DistributionKernel {
 public:
  EndedKernel(int number, double top)
      : DistributionKernel(DistributionSplash::thesis_case(number), 0.05, top) {}
  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<EndedKernel>(*this); }
  double cut_off(const std::vector<double>&) const override { return 0; }
};

constexpr double percent = 0.01;

/// A row of the specification's table in sec. 5.2; zero where it gives nothing.
struct Row52 {
  int number;
  double u, thesis, surface, rate, flux, surface62, flux62;
};
const Row52 table_4_5[] = {{1, 35, 33.1, 29.6, 62, .0433, 32.7, .0217},
                           {1, 75, 29.0, 26.15, 867, .651, 29.2, .690},
                           {1, 125, 24.8, 22.05, 2597, 2.131, 24.65, 2.33},
                           {2, 35, 25.1, 21.9, 248, .0811, 25.5, .068},
                           {2, 75, 20.1, 16.9, 1812, .635, 20.4, .667},
                           {2, 125, 13.9, 11.5, 5375, 2.02, 14.3, 2.17},
                           {3, 35, 35.0, 31.6, 57, .0237, 0, 0},
                           {3, 75, 30.6, 26.25, 1298, .560, 31.3, .565},
                           {3, 125, 24.2, 19.2, 4192, 1.88, 23.8, 1.99},
                           {4, 35, 26.4, 21.5, 227, .127, 24.6, .110},
                           {4, 50, 24.6, 19.3, 646, .368, 22.4, .365},
                           {4, 75, 20.9, 15.6, 1701, .989, 18.5, 1.02},
                           {5, 50, 40.6, 35.3, 282, .202, 40.4, .149},
                           {5, 100, 35.7, 31.0, 2010, 1.57, 35.85, 1.61},
                           {5, 150, 31.1, 27.4, 4779, 4.07, 31.4, 4.31},
                           {6, 50, 28.0, 22.4, 970, .309, 26.75, .290},
                           {6, 100, 20.4, 16.8, 5105, 1.74, 20.2, 1.80},
                           {6, 150, 12.1, 14.1, 12630, 4.52, 15.7, 4.77}};

std::string name_of(int number, double u) { return fmt::format("case {}, u* {:g}", number, u); }

void conveyor_rows(AccuracyTable& table) {
  table.section("Conveyor belt, C1 to C8", "Saltation specification 5.1; without dimensions.");
  const DeltaConveyor d({1000, 0, 0.6}, [](double) { return 0.8; });
  const auto fixed = d.fixed_point();
  const auto eigenvalues = d.eigenvalues(fixed.state);
  table.row("C1 case D, v_o", 1.25, fixed.state.speed, 1e-6);
  table.row("C1 case D, v_c", 5, fixed.belt_speed, 1e-6);
  table.row("C1 case D, F", 200, fixed.state.flux, 1e-6);
  table.row("C1 larger eigenvalue of the map", 0.7867, eigenvalues[0], 1e-4);
  const struct {
    char name;
    double gamma, delta, belt, mean, spread, flux;
  } cases[] = {{'A', 0, 1, 14.124, 3.917, 0.891, 23.06},
               {'B', 0.004, 0.2, 14.124, 3.887, 0.946, 23.24},
               {'C', 0.2, 0.5, 13.639, 2.001, 1.662, 45.0}};
  for (const auto& c : cases) {
    ConveyorSplash splash;
    splash.gamma = c.gamma;
    splash.delta = c.delta;
    const SpectrumConveyor conveyor({1000, 0.05, 0.6}, splash);
    const auto s = conveyor.solve();
    double n = 0, first = 0, second = 0;
    for (int i = 0; i < 40; ++i) {
      const double v = conveyor.launch_speed(i), f = s.flux[static_cast<std::size_t>(i)];
      n += f;
      first += f * v;
      second += f * v * v;
    }
    const std::string name = fmt::format("C2 case {}, ", c.name);
    table.relative_row(name + "v_c", c.belt, s.belt_speed, 0.5 * percent);
    table.relative_row(name + "mean v", c.mean, first / n, 0.5 * percent);
    table.relative_row(name + "standard deviation", c.spread, std::sqrt(second / n - first * first / n / n),
                       0.5 * percent);
    table.relative_row(name + "sum of F", c.flux, n, 0.5 * percent);
    std::vector<double> flat(40, 1.0), single(40, 0.0);
    single[20] = 10;
    const int steps =
        std::max(conveyor.iterate(flat, 0.01).iterations, conveyor.iterate(single, 0.01).iterations);
    table.range_row(fmt::format("C6 case {}, steps to 1 % from flat and from one bin", c.name), 1, 50, steps);
    if (c.name == 'A') {
      const auto twice = SpectrumConveyor({2000, 0.05, 0.6}, splash).solve();
      table.relative_row("C4 case A, sum of F at twice the power over once", 2.010,
                         std::accumulate(twice.flux.begin(), twice.flux.end(), 0.0) / n, 0.5 * percent);
      const auto weak = SpectrumConveyor({9, 0.05, 0.6}, splash).solve();
      table.row("C7 case A, flux at too little power", 0,
                std::accumulate(weak.flux.begin(), weak.flux.end(), 0.0), 0);
    }
    if (c.name == 'B') {
      const auto column = conveyor.column(7.375, s.belt_speed);
      table.relative_row("C5 case B, grains from mu = 7.375", 1.256,
                         0.25 * std::accumulate(column.begin(), column.end(), 0.0), 0.5 * percent);
    }
  }
  const DeltaConveyor e({1000, 0, 0.6}, [](double v) { return 0.7 - 0.1 * std::tanh((v - 1) / 0.05); });
  DeltaConveyor::State state = e.fixed_point().state;
  state.speed *= 1.01;
  for (int i = 0; i < 4000; ++i) state = e.next(state);
  const DeltaConveyor::State other = e.next(state);
  table.row("C8 case E, faster state of the cycle, v", 1.178, std::max(state.speed, other.speed), 1e-3);
  table.row("C8 case E, slower state, v", 1.002, std::min(state.speed, other.speed), 1e-3);
}

void state_rows(AccuracyTable& table) {
  table.section(
      "W1: u*_eff and flux, printed parameters",
      "Specification 5.2, [R]: cm/s, g/(cm s). In case 4 the reference ended its launches at 500 cm/s; "
      "exp(-v/80) leaves 0.2 % of the grains above, which carry 2 % of the flux. So case 4 is judged on "
      "that grid, and told on the whole one.");
  for (const Row52& r : table_4_5) {
    const SaltationSolver solver =
        r.number == 4 ? SaltationSolver(thesis_bed(1), EndedKernel(4, 5)) : thesis_solver(r.number);
    const SteadyState s = solver.solve(r.u / 100);
    const bool near_threshold = r.u < 120 * solver.impact_threshold().value_or(0);
    const std::string name = name_of(r.number, r.u);
    table.relative_row(name + ", u*_eff", r.surface, 100 * s.surface_friction_velocity,
                       (r.number == 6 && r.u == 150 ? 3 : 1.5) * percent);
    table.relative_row(name + ", Q", r.flux, 10 * s.mass_flux(), (near_threshold ? 4 : 1.5) * percent);
    if (r.number == 4) {
      const SteadyState whole = thesis_solver(4).solve(r.u / 100);
      table.remark(name + ", u*_eff, whole spectrum", r.surface, 100 * whole.surface_friction_velocity);
      table.remark(name + ", Q, whole spectrum", r.flux, 10 * whole.mass_flux());
    }
  }
  table.section(
      "W2: the thesis' table 4.5 with drag x 0.62",
      "The printed parameters do not give the printed table (W1 against [T] differs by 10 to 25 %): its code "
      "must have had a weaker drag; 0.62 is fitted, the cause is not known (specification 5.2). Case 6 at "
      "150 is "
      "told only.");
  for (const Row52& r : table_4_5) {
    const SteadyState s = thesis_solver(r.number, 0.62).solve(r.u / 100);
    const std::string name = name_of(r.number, r.u) + ", u*_eff";
    if (r.surface62 == 0)
      table.statement(name + ", 35.0 in the thesis: nothing moves", s.reason, !s.steady());
    else if (r.number == 6 && r.u == 150)
      table.remark(name, r.thesis, 100 * s.surface_friction_velocity);
    else
      table.relative_row(name, r.thesis, 100 * s.surface_friction_velocity,
                         (r.number == 4 ? 13 : 8) * percent);
  }
  table.section("W2: both columns of the specification at drag x 0.62", "Against [R], cm/s.");
  for (const Row52& r : table_4_5)
    if (r.surface62 > 0)
      table.relative_row(name_of(r.number, r.u) + ", u*_eff", r.surface62,
                         100 * thesis_solver(r.number, 0.62).solve(r.u / 100).surface_friction_velocity,
                         (r.number == 6 && r.u == 150 ? 3 : 1.5) * percent);

  table.section("W3 to W6", "Conservation, and the threshold below which nothing is solved.");
  const double nominal[] = {29.96, 23.2, 32.0, 23.0, 36.4, 25.3};
  const double compatible[] = {32.8, 26.4, 36.5, 25.8, 41.1, 29.3};
  for (int number = 1; number <= 6; ++number) {
    const double part = (number > 4 ? 3 : 1.5) * percent;
    table.relative_row(fmt::format("W6 case {}, u*_it", number), nominal[number - 1],
                       100 * thesis_solver(number).impact_threshold().value_or(0), part);
    table.relative_row(fmt::format("W6 case {}, u*_it, drag x 0.62", number), compatible[number - 1],
                       100 * thesis_solver(number, 0.62).impact_threshold().value_or(0), part);
  }
  double momentum = 0, flux = 0, number_balance = 0;
  bool falls = true;
  for (int number = 1; number <= 6; ++number) {
    const SaltationSolver solver = thesis_solver(number);
    double last = 1;
    for (const double u : {0.5, 0.75, 1.0, 1.25}) {
      const SteadyState s = solver.solve(u);
      const SaltationProfiles p = profiles(s, solver.bed());
      falls = falls && s.surface_friction_velocity < last;
      last = s.surface_friction_velocity;
      const double lost = 1.23 * (u * u - last * last);
      momentum = std::max(momentum, std::abs(s.grain_stress[0] / lost - 1));
      momentum = std::max(momentum, std::abs(p.stress() / s.grain_stress[0] - 1));
      flux = std::max(flux, std::abs(p.mass_flux(s.grain_mass) / s.mass_flux() - 1));
      number_balance = std::max(number_balance, std::abs(s.replacement - 1));
    }
  }
  table.statement("W3 u*_eff falls as u* rises, all cases", falls ? "everywhere" : "not everywhere", falls);
  table.row("W4 momentum lost by the wind over that gained by the grains, less one (issue: 1e-8)", 0,
            momentum, 1e-8);
  table.row("W5 flux from hop lengths over that from the profile, less one", 0, flux, 0.005);
  table.row("number of grains that leave for one that lands, less one", 0, number_balance, 1e-3);
}

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

void profile_rows(AccuracyTable& table) {
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
      const SaltationProfiles q = profiles(smooth, solver.bed(), layer);
      for (std::size_t i = 0; i + 1 < q.height.size() / 2; ++i)
        monotone = monotone && q.number_density[i + 1] < q.number_density[i];
    }
  }
  table.statement("P1 drag peaks below flux, flux below energy (case 6: drag below energy)",
                  ordered ? "all" : "not all", ordered);
  table.statement("P2 peaks of energy and drag do not fall as u* rises (one layer of slack)",
                  rising ? "all" : "not all", rising);
  table.statement("P5 number density falls with height, cases 2 to 4 (lower half; bins of 1 cm/s)",
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
}

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

void coarse_rows(AccuracyTable& table) {
  table.section(
      "Coarse sand (case 7)",
      "Specification 5.7: a splash rebuilt from the experiment's table (CoarseSandRebound, "
      "CoarseSandEjection), "
      "drawn into bins; the thesis' own four-index table is not recoverable. u* = 100 cm/s unless said.");
  for (const double scale : {1.0, 0.62}) {
    SaltatingBed bed = thesis_bed(scale);
    bed.grain.diameter = coarse_sand_diameter;
    const auto splash = std::make_shared<ComposedSplash>(std::make_shared<CoarseSandRebound>(bed.grain),
                                                         std::make_shared<CoarseSandEjection>(bed.grain));
    SplashSampling sampling;
    sampling.slowest = 1.414;
    const SaltationSolver solver(bed,
                                 SampledKernel(splash, "coarse_sand", bed.grain, bed.atmosphere, sampling));
    const std::string drag = fmt::format(", drag x {:g}", scale);
    const SteadyState s = solver.solve(1);
    const SteadyState strong = solver.solve(1.25);
    table.range_row("u*_eff" + drag, 18, 30, 100 * s.surface_friction_velocity);
    table.statement("u*_eff falls with u*" + drag,
                    fmt::format("{:.1f} at 100, {:.1f} at 125", 100 * s.surface_friction_velocity,
                                100 * strong.surface_friction_velocity),
                    strong.surface_friction_velocity < s.surface_friction_velocity);
    double back = 0, fast = 0, steep = 0;
    for (std::size_t k = 0; k < s.launches.size(); ++k) {
      const double n = s.launches.number[k];
      if (s.launches.vx[k] < -0.5) back += n / s.impact_rate();
      if (std::hypot(s.landings.vx[k], s.landings.vy[k]) < 3) continue;
      fast += n;
      if (std::atan2(s.landings.vy[k], s.landings.vx[k]) > 21 * M_PI / 180) steep += n;
    }
    table.range_row("backward launches [%]" + drag, 0, 1, 100 * back);
    table.range_row("impacts over 300 cm/s that are steeper than 21 degrees [%]" + drag, 0, 0.5,
                    100 * steep / fast);
  }
}

void sand_rows(AccuracyTable& table) {
  table.section(
      "Real sand: Kok & Renno's splash",
      "Against the prototype of specification 7 (its own choice of angles and slow grains is not printed, so "
      "told, not "
      "judged), SI and degrees. Balanced: the same splash drawn with its rejection of events that break "
      "conservation.");
  SaltatingBed bed;
  const SaltationSolver free(bed, KokRennoKernel(bed.grain, bed.atmosphere));
  const auto composed = std::make_shared<ComposedSplash>(std::make_shared<KokRennoRebound>(),
                                                         std::make_shared<KokRennoEjection>(bed.grain));
  const SaltationSolver balanced(bed, SampledKernel(composed, "balanced", bed.grain, bed.atmosphere));
  const struct {
    double u, surface, flux, height, length, speed, angle;
  } rows[] = {{0.22, .2078, .00114, .0121, .134, 1.37, 13.6},
              {0.30, .1995, .01137, .0124, .140, 1.38, 13.8},
              {0.40, .1885, .02977, .0128, .148, 1.39, 14.1},
              {0.50, .1774, .0551, .0131, .157, 1.41, 14.5},
              {0.70, .157, .1294, .0138, .176, 1.43, 15.1}};
  for (const SaltationSolver* solver : {&free, &balanced}) {
    const std::string who = solver == &free ? ", mean" : ", balanced";
    const double threshold = *solver->impact_threshold();
    table.relative_row("u*_it, 0.25 mm" + who, 0.209, threshold, 5 * percent);
    std::vector<double> u, flux, z50;
    for (const auto& r : rows) {
      const SteadyState s = solver->solve(r.u);
      const SaltationState means = summary(s, threshold);
      const SaltationProfiles p = profiles(s, bed);
      u.push_back(r.u);
      flux.push_back(s.mass_flux());
      z50.push_back(p.median_height(p.number_flux));
      const std::string name = fmt::format("u* {:.2f}", r.u) + who;
      table.remark(name + ", u*_eff", r.surface, s.surface_friction_velocity);
      table.remark(name + ", Q", r.flux, s.mass_flux());
      table.remark(name + ", hop height", r.height, means.hop_height);
      table.remark(name + ", hop length", r.length, means.hop_length);
      table.remark(name + ", impact speed", r.speed, means.impact_speed);
      table.remark(name + ", impact angle", r.angle, means.impact_angle * 180 / M_PI);
    }
    table.range_row("slope of ln Q over ln(u*^2 - u*_it^2)" + who, 0.95, 1.10,
                    excess_stress_exponent(threshold, u, flux));
    table.range_row("growth of the height of half of the flux, u* 0.22 to 0.70 [%]" + who, -50, 50,
                    100 * (z50.back() / z50.front() - 1));
    table.range_row("impact over fluid threshold" + who, 0.75, 0.95, threshold / bed.fluid_threshold());
    const double law = 5 * bed.atmosphere.density / 9.81 * threshold * (0.16 - threshold * threshold);
    table.range_row("Q at u* 0.40 over the law of Duran & Kok" + who, 1 / 2.5, 2.5, flux[2] / law);
  }
  TransientSaltation transient(bed, KokRennoKernel(bed.grain, bed.atmosphere, {}, 3, 8));
  double steady = free.solve(0.4).mass_flux(), ninety = 0;
  while (transient.time() < 4) {
    transient.advance(0.05, 0.4);
    if (ninety == 0 && transient.mass_flux() > 0.9 * steady) ninety = transient.time();
  }
  table.range_row("time from rest to 90 % of the flux, u* 0.40 [s]", 0.5, 3, ninety);
  table.relative_row("flux after 4 s, eq. 4.35, over the steady state", 1, transient.mass_flux() / steady,
                     2 * percent);
}

double milliseconds(const std::function<void()>& work, int times) {
  double least = 1e300;
  for (int n = 0; n < times; ++n) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

void convergence() {
  fmt::print(
      "\n## Error against run time\n\nCase 1 at u* = 75 cm/s, against bins of 1.25 cm/s solved to 1e-6 with "
      "flights to 1e-7. Processor time of "
      "one core, least of five.\n\n| what | setting | steps | time [ms] | error of u*_eff [%] | error of Q "
      "[%] |\n"
      "|---|---|---|---|---|---|\n");
  const SaltatingBed bed = thesis_bed(1);
  const auto splash = DistributionSplash::thesis_case(1);
  const SteadyState exact =
      SaltationSolver(bed, DistributionKernel(splash, 0.0125), {1e-6, 1e-7, 200}).solve(0.75);
  const auto row = [&](const std::string& what, const std::string& setting, double time,
                       const SteadyState& s) {
    fmt::print("| {} | {} | {} | {:.2f} | {:.3f} | {:.3f} |\n", what, setting, s.iterations, time,
               100 * std::abs(s.surface_friction_velocity / exact.surface_friction_velocity - 1),
               100 * std::abs(s.mass_flux() / exact.mass_flux() - 1));
  };
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    const DistributionKernel kernel(splash);
    row("literal iteration", fmt::format("tolerance {:g}", tolerance),
        milliseconds([&] { literal_iteration(bed, kernel, 0.75, tolerance); }, 3),
        literal_iteration(bed, kernel, 0.75, tolerance));
  }
  for (const double width : {0.2, 0.1, 0.05, 0.025}) {
    const SaltationSolver solver(bed, DistributionKernel(splash, width));
    row("solver", fmt::format("bins of {:g} cm/s", 100 * width), milliseconds([&] { solver.solve(0.75); }, 5),
        solver.solve(0.75));
  }
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const SaltationSolver solver(bed, DistributionKernel(splash), {tolerance, 1e-4, 200});
    row("solver", fmt::format("tolerance {:g}", tolerance), milliseconds([&] { solver.solve(0.75); }, 5),
        solver.solve(0.75));
  }
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const SaltationSolver solver(bed, DistributionKernel(splash), {1e-3, tolerance, 200});
    row("solver", fmt::format("flights to {:g}", tolerance), milliseconds([&] { solver.solve(0.75); }, 5),
        solver.solve(0.75));
  }
  const auto kernels = [&](const SaltatingBed&) { return std::make_unique<DistributionKernel>(splash); };
  const SaltationTable table =
      SaltationTable::build(bed, kernels, {0.00024, 0.00026}, SaltationTable::usual_ratios());
  constexpr int many = 100000;
  double sum = 0;
  const double look_up = milliseconds(
      [&] {
        for (int n = 0; n < many; ++n) sum += table.state(0.75 + 1e-9 * n, 0.00025).mass_flux;
      },
      5);
  const SaltationState t = table.state(0.75, 0.00025);
  fmt::print("| table | {} diameters, {} ratios | - | {:.6f} | {:.3f} | {:.3f} |\n", 2, 10, look_up / many,
             100 * std::abs(t.surface_friction_velocity / exact.surface_friction_velocity - 1),
             100 * std::abs(t.mass_flux / exact.mass_flux() - 1));
  const FluxLaw law = table.law(0.00025);
  const double three = milliseconds(
      [&] {
        for (int n = 0; n < many; ++n) sum += law.flux(0.75 + 1e-9 * n);
      },
      5);
  fmt::print("| three-number law | - | - | {:.7f} | - | {:.3f} |\n", three / many,
             100 * std::abs(law.flux(0.75) / exact.mass_flux() - 1));
  if (!(sum > 0)) fmt::print("\n");
}

void write_page() {
  AccuracyTable table;
  conveyor_rows(table);
  state_rows(table);
  case_1_rows(table);
  profile_rows(table);
  flux_rows(table);
  height_rows(table);
  coarse_rows(table);
  sand_rows(table);
  fmt::print(
      "# Accuracy of saltation\n\nPrinted by `./twin bench saltation_accuracy`. [T]: printed in Werner "
      "(1987); [R]: the "
      "reference solver of the saltation specification.\n\n{}",
      table.markdown());
  convergence();
}

}  // namespace
}  // namespace aeolian

int main() { aeolian::write_page(); }
