#include <algorithm>
#include <memory>
#include <vector>

#include "saltation_rows.hpp"

#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/kok_renno.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"

namespace aeolian {
namespace {

struct Steps {
  int states = 0, sum = 0, most = 0;

  void count(int steps) {
    ++states;
    sum += steps;
    most = std::max(most, steps);
  }
  double mean() const { return static_cast<double>(sum) / states; }
};

/// Winds [m/s], each a fiftieth stronger than the one before, and back.
std::vector<double> winds_between(double weakest, double strongest) {
  std::vector<double> winds;
  for (double u = weakest; u < strongest; u *= 1.02) winds.push_back(u);
  for (std::size_t n = winds.size() - 1; n-- > 0;) winds.push_back(winds[n]);
  return winds;
}

void rows_of(AccuracyTable& table, const std::string& name, const SaltationSolver& solver, double weakest,
             double strongest) {
  const std::vector<double> winds = winds_between(weakest, strongest);
  Steps cold, warm;
  SteadyState state = solver.solve(winds.front());
  for (std::size_t n = 1; n < winds.size(); ++n) {
    state = solver.solve(winds[n], &state);
    warm.count(state.iterations);
    if (n % 8 == 0) cold.count(solver.solve(winds[n]).iterations);
  }
  table.range_row(fmt::format("{}, cold, most of {}", name, cold.states), 0, 25, cold.most);
  table.range_row(fmt::format("{}, warm, mean of {}", name, warm.states), 0, 5, warm.mean());
  table.range_row(fmt::format("{}, warm, most of {}", name, warm.states), 0, 5, warm.most);
}

}  // namespace

void step_rows(AccuracyTable& table) {
  table.section(
      "Steps to a steady state",
      "Up to 25 from a cold start and up to 5 from a neighbouring state are asked for. Warm: winds "
      "that rise and fall by 2 % from one to the next, each begun from the last; cold: every eighth "
      "of them.");
  for (int number = 1; number <= 6; ++number) {
    const double strongest = number < 4 ? 1.25 : number == 4 ? 0.75 : 1.5;
    rows_of(table, fmt::format("case {}", number), thesis_solver(number), number < 5 ? 0.35 : 0.5, strongest);
  }
  const SaltatingBed bed;
  rows_of(table, "Kok & Renno", {bed, KokRennoKernel(bed.grain, bed.atmosphere)}, 0.25, 0.9);
  const auto balanced = std::make_shared<ComposedSplash>(std::make_shared<KokRennoRebound>(),
                                                         std::make_shared<KokRennoEjection>(bed.grain));
  rows_of(table, "Kok & Renno, balanced",
          {bed, SampledKernel(balanced, "balanced", bed.grain, bed.atmosphere)}, 0.3, 0.7);
}

}  // namespace aeolian
