// The accuracy of snow that slides and piles up as a Markdown page: docs/accuracy/slide.md is what this
// prints.
//
//     ./twin bench slide_accuracy

#include "slide_rows.hpp"
#include <fmt/format.h>

int main() {
  aeolian::AccuracyTable table;
  aeolian::slide_law_rows(table);
  aeolian::slide_engine_rows(table);
  aeolian::slide_collapse_rows(table);
  aeolian::slide_pile_rows(table);
  aeolian::slide_sensitivity_rows(table);
  aeolian::slide_calibration_rows(table);
  aeolian::slide_surrogate_rows(table);
  fmt::print(
      "# Accuracy of snow slides\n\nPrinted by `./twin bench slide_accuracy`. Targets are those of the "
      "specification after Frischholz, of closed formulae, and of published experiments.\n\n{}",
      table.markdown());
}
