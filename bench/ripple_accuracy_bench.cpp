// The accuracy of ripple theory and models as a Markdown page: docs/accuracy/ripples.md is what this prints.
//
//     ./twin bench ripple_accuracy

#include "ripple_rows.hpp"
#include <fmt/format.h>

int main() {
  aeolian::AccuracyTable table;
  aeolian::theory_rows(table);
  aeolian::lattice_rows(table);
  aeolian::model_rows(table);
  aeolian::comparison_rows(table);
  aeolian::tracking_rows(table);
  aeolian::sorting_rows(table);
  fmt::print(
      "# Accuracy of ripples\n\nPrinted by `./twin bench ripple_accuracy`. Targets are those of Werner "
      "(1987), "
      "ch. V and VI, and figures recomputed from the equations there; numbers of rows are those of the "
      "acceptance table. Where a figure was drawn at random, the statistical error is one standard error of "
      "ours.\n\n{}",
      table.markdown());
}
