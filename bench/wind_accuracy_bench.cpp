// The accuracy of the wind over terrain as a Markdown page: docs/accuracy/wind.md is what this prints.
//
//     ./twin bench wind_accuracy

#include "wind_rows.hpp"
#include <fmt/format.h>

int main() {
  aeolian::AccuracyTable table;
  aeolian::linear_rows(table);
  aeolian::volume_rows(table);
  aeolian::askervein_rows(table);
  aeolian::gust_rows(table);
  aeolian::sph_rows(table);
  fmt::print(
      "# Accuracy of the wind over terrain\n\nPrinted by `./twin bench wind_accuracy`. Targets are analytic "
      "results and measurements as collected in the acceptance checks of the wind spec (labels F, G, C, E); "
      "tolerances are its own. Hills have height H and half-width L at half height; speed-up is told in "
      "units "
      "of H/L unless said otherwise.\n\n![error against run time](wind_time.svg)\n\n{}",
      table.markdown());
}
