// How well the twin learns its parameters, as a Markdown page: docs/accuracy/learning.md is what this prints.
//
//     ./twin bench learning_accuracy

#include "learning_rows.hpp"
#include <fmt/format.h>

int main() {
  const std::string folder = AEOLIAN_REPOSITORY "/catkin_ws/build/learning_days";
  aeolian::AccuracyTable table;
  aeolian::same_model_rows(table, folder);
  aeolian::lattice_day_rows(table, folder);
  aeolian::scanned_day_rows(table, folder);
  aeolian::noisy_day_rows(table, folder);
  fmt::print("# Accuracy of learning\n\nPrinted by `./twin bench learning_accuracy`. {}", table.markdown());
}
