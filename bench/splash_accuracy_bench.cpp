// The accuracy of grains, impacts and splash as a Markdown page: docs/accuracy/splash.md is what this prints.
//
//     ./twin bench splash_accuracy

#include "splash_rows.hpp"
#include <fmt/format.h>

int main() {
  aeolian::AccuracyTable table;
  fmt::print(
      "# Accuracy of the splash\n\nPrinted by `./twin bench splash_accuracy`. Targets are those of Werner "
      "(1987) and of the "
      "literature; where a figure was drawn at random, the statistical error is one standard error of "
      "ours.\n\n{}",
      table.markdown());
}
