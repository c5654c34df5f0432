// The accuracy of saltation as a Markdown page: docs/accuracy/saltation.md is what this prints.
//
//     ./twin bench saltation_accuracy

#include "saltation_convergence.hpp"
#include "saltation_grid.hpp"
#include "saltation_rows.hpp"

namespace aeolian {
namespace {

void write_convergence() {
  fmt::print(
      "\n## Error against run time\n\n![Error against run time](saltation_time.svg)\n\nCase 1 at u* = 75 "
      "cm/s, against "
      "bins of 1.25 cm/s solved to 1e-6 with flights to 1e-7. Processor time of one core, least of five; the "
      "picture is "
      "drawn by `saltation_figure_bench docs/accuracy`.\n\n"
      "| what | setting | steps | time [ms] | error of u*_eff [%] | error of Q [%] "
      "|\n|---|---|---|---|---|---|\n");
  for (const Convergence& c : measure_convergence())
    fmt::print("| {} | {} | {} | {:.3g} | {} | {:.3f} |\n", c.way, c.setting,
               c.steps > 0 ? fmt::format("{}", c.steps) : "-", c.milliseconds,
               std::isnan(c.surface_error) ? "-" : fmt::format("{:.3f}", 100 * c.surface_error),
               100 * c.flux_error);
}

void write_grids() {
  fmt::print(
      "\n## Error against the grid\n\n![Error against the grid](saltation_grid.svg)\n\nEach grid against the "
      "finest of its kind, all else equal, solved to 1e-8: 0.625 cm/s; flights to 1e-8; 32 bins in an "
      "octave; 112 "
      "angles. Case 1 at u* = 75 cm/s, sand of 0.25 mm at u* = 40 cm/s. In bold what the solver takes by "
      "itself.\n\n"
      "| grid | size | error of u*_eff [%] | error of Q [%] |\n|---|---|---|---|\n");
  for (const GridError& e : measure_grids())
    fmt::print("| {} | {} | {:.2g} | {:.2g} |\n", e.grid,
               e.usual ? fmt::format("**{:g}**", e.size) : fmt::format("{:g}", e.size), 100 * e.surface,
               100 * e.flux);
}

void write_page() {
  AccuracyTable table;
  conveyor_rows(table);
  state_rows(table);
  profile_rows(table);
  flux_rows(table);
  sand_rows(table);
  mixture_rows(table);
  step_rows(table);
  fmt::print(
      "# Accuracy of saltation\n\nPrinted by `./twin bench saltation_accuracy`. [T]: printed in Werner "
      "(1987); [R]: "
      "the reference solver of the saltation specification.\n\n{}",
      table.markdown());
  write_convergence();
  write_grids();
}

}  // namespace
}  // namespace aeolian

int main() { aeolian::write_page(); }
