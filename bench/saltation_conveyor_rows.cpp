#include <algorithm>
#include <cmath>
#include <numeric>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/conveyor.hpp"

namespace aeolian {
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

}  // namespace aeolian
