// The accuracy of saltation as a Markdown page: docs/accuracy/saltation.md is what this prints.
//
//     ./twin bench saltation_accuracy

#include "saltation_convergence.hpp"
#include "saltation_rows.hpp"

namespace aeolian {
namespace {

void write_convergence() {
  fmt::print(
      "\n## Error against run time\n\n![Error against run time](saltation_time.svg)\n\nCase 1 at u* = 75 "
      "cm/s, against "
      "bins of 1.25 cm/s solved to 1e-6 with flights to 1e-7. Processor time of one core, least of five; the "
      "picture is "
      "drawn by `saltation_figure_bench FILE.svg`.\n\n"
      "| what | setting | steps | time [ms] | error of u*_eff [%] | error of Q [%] "
      "|\n|---|---|---|---|---|---|\n");
  for (const Convergence& c : measure_convergence())
    fmt::print("| {} | {} | {} | {:.3g} | {} | {:.3f} |\n", c.way, c.setting,
               c.steps > 0 ? fmt::format("{}", c.steps) : "-", c.milliseconds,
               std::isnan(c.surface_error) ? "-" : fmt::format("{:.3f}", 100 * c.surface_error),
               100 * c.flux_error);
}

void write_page() {
  AccuracyTable table;
  conveyor_rows(table);
  state_rows(table);
  profile_rows(table);
  flux_rows(table);
  sand_rows(table);
  fmt::print(
      "# Accuracy of saltation\n\nPrinted by `./twin bench saltation_accuracy`. [T]: printed in Werner "
      "(1987); [R]: "
      "the reference solver of the saltation specification.\n\n{}",
      table.markdown());
  write_convergence();
}

}  // namespace
}  // namespace aeolian

int main() { aeolian::write_page(); }
