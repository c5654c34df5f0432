#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "saltation_rows.hpp"

#include "aeolian_core/saltation/literal_iteration.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"

namespace aeolian {

/// One way to a state of case 1, u* 75 cm/s: how long it takes and how wrong it is.
struct Convergence {
  std::string way, setting;
  int steps;             ///< zero: none
  double milliseconds;   ///< of processor time, least of some
  double surface_error;  ///< of u*_eff, relative; NaN where it is not told
  double flux_error;
};

inline double least_milliseconds(const std::function<void()>& work, int times) {
  double least = 1e300;
  for (int n = 0; n < times; ++n) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

inline std::vector<Convergence> measure_convergence() {
  constexpr double wind = 0.75;
  const SaltatingBed bed = thesis_bed();
  const auto splash = DistributionSplash::thesis_case(1);
  const SteadyState exact =
      SaltationSolver(bed, DistributionKernel(splash, 0.0125), {1e-6, 1e-7, 200}).solve(wind);
  std::vector<Convergence> rows;
  const auto add = [&](const std::string& way, const std::string& setting,
                       const std::function<SteadyState()>& solve) {
    const SteadyState s = solve();
    rows.push_back({way, setting, s.iterations, least_milliseconds([&] { solve(); }, 5),
                    std::abs(s.surface_friction_velocity / exact.surface_friction_velocity - 1),
                    std::abs(s.mass_flux() / exact.mass_flux() - 1)});
  };
  const auto solver = [&](const std::string& setting, double width, const SolverSettings& settings) {
    const SaltationSolver one(bed, DistributionKernel(splash, width), settings);
    add("solver", setting, [&] { return one.solve(wind); });
  };
  for (const double tolerance : {1e-1, 1e-2, 1e-3})
    add("literal iteration", fmt::format("tolerance {:g}", tolerance),
        [&] { return literal_iteration(bed, DistributionKernel(splash), wind, tolerance); });
  for (const double width : {0.2, 0.1, 0.05, 0.025})
    solver(fmt::format("bins of {:g} cm/s", 100 * width), width, {});
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4})
    solver(fmt::format("tolerance {:g}", tolerance), 0.05, {tolerance, 1e-4, 200});
  for (const double tolerance : {1e-3, 1e-4, 1e-5})
    solver(fmt::format("flights to {:g}", tolerance), 0.05, {1e-3, tolerance, 200});

  const SaltationTable table = SaltationTable::build(
      bed, [&](const SaltatingBed&) { return std::make_unique<DistributionKernel>(splash); },
      {0.00024, 0.00026}, SaltationTable::usual_ratios());
  const FluxLaw law = table.law(0.00025);
  constexpr int many = 100000;
  double sum = 0;
  const auto repeated = [&](const std::function<double(double)>& flux) {
    return least_milliseconds(
               [&] {
                 for (int n = 0; n < many; ++n) sum += flux(wind + 1e-9 * n);
               },
               5) /
           many;
  };
  const SaltationState found = table.state(wind, 0.00025);
  rows.push_back({"table", "2 diameters, 10 ratios", 0,
                  repeated([&](double u) { return table.state(u, 0.00025).mass_flux; }),
                  std::abs(found.surface_friction_velocity / exact.surface_friction_velocity - 1),
                  std::abs(found.mass_flux / exact.mass_flux() - 1)});
  rows.push_back({"three-number law", "", 0, repeated([&](double u) { return law.flux(u); }), std::nan(""),
                  std::abs(law.flux(wind) / exact.mass_flux() - 1)});
  return sum > 0 ? rows : std::vector<Convergence>{};
}

}  // namespace aeolian
