// The accuracy of erosion by parcels as a Markdown page: docs/accuracy/erosion.md is what this prints.
//
//     ./twin bench erosion_accuracy

#include "erosion_rows.hpp"
#include <fmt/format.h>

int main() {
  aeolian::AccuracyTable table;
  aeolian::erosion_golden_rows(table);
  aeolian::erosion_thesis_rows(table);
  aeolian::erosion_snow_rows(table);
  fmt::print(
      "# Accuracy of erosion\n\nPrinted by `./twin bench erosion_accuracy`. Targets are those of the "
      "specification after Szabo (2019) and of the field papers that it quotes. Misses are told as they "
      "are.\n\n{}",
      table.markdown());
}
