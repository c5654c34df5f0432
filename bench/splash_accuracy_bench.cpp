// The accuracy of grains, impacts and splash as a Markdown page: docs/accuracy/splash.md is what this prints.
//
//     ./twin bench splash_accuracy
//     rosrun aeolian_twin splash_accuracy_bench FOLDER  # notes impacts there and goes on with them
//     rosrun aeolian_twin splash_accuracy_bench figure | gnuplot > docs/accuracy/splash_functions.png

#include <filesystem>
#include <string>

#include "splash_rows.hpp"
#include <fmt/format.h>
#include <unistd.h>

int main(int count, char** arguments) {
  if (count == 2 && std::string(arguments[1]) == "figure") {
    aeolian::print_splash_figure();
    return 0;
  }
  namespace fs = std::filesystem;
  const fs::path own = fs::temp_directory_path() / fmt::format("splash_accuracy_{}", getpid());
  const std::string folder = count == 2 ? arguments[1] : own.string();
  aeolian::AccuracyTable table;
  aeolian::rebound_rows(table);
  aeolian::experiment_rows(table);
  aeolian::literature_rows(table);
  aeolian::table_rows(table);
  aeolian::shipped_rows(table);
  aeolian::impact_rows(table, folder);
  aeolian::box_rows(table, folder);
  aeolian::sleep_rows(table);
  fs::remove_all(own);
  fmt::print(
      "# Accuracy of the splash\n\nPrinted by `./twin bench splash_accuracy`. Targets are those of Werner "
      "(1987) and of the "
      "literature; where a figure was drawn at random, the statistical error is one standard error of "
      "ours.\n\n"
      "![All splash functions](splash_functions.png)\n\nFine sand of 0.25 mm; drawn by `rosrun aeolian_twin "
      "splash_accuracy_bench figure | gnuplot > docs/accuracy/splash_functions.png`.\n\n{}",
      table.markdown());
}
