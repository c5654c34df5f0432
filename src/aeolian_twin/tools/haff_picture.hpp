#pragma once

#include <cmath>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/bedforms/lattice/haff_bed.hpp"
#include "aeolian_core/bedforms/theory/periodic_profile.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/tools/theory_tables.hpp"

namespace aeolian {

/// Writes haff_profiles.csv and haff.svg: the bed after 30, 95 and 300 impacts per grain diameter, without
/// and with a limit to the stoss.
inline void draw_haff(const std::string& out, std::uint64_t seed) {
  constexpr double shown = 1600;  // of 4000 d
  constexpr double times[] = {30, 95, 300};
  HaffParameters parameters;
  HaffParameters limited = parameters;
  limited.steepest_stoss = 10 * M_PI / 180;
  std::ostringstream script;
  script << plot_style << "set multiplot\nunset key\n"
         << fmt::format("set xrange [0:{}]\nset yrange [-50:60]\nset ytics 40\n", shown);
  Table table{{"x_d"}, {{}}};
  for (int bin = 0; bin < parameters.bins; ++bin)
    table.columns[0].push_back(parameters.bin_length * (bin + 0.5));
  for (const bool limit : {false, true}) {
    HaffBed bed(limit ? limited : parameters, seed);
    double elapsed = 0;
    for (int i = 0; i < 3; ++i) {
      bed.advance(times[i] - elapsed);
      elapsed = times[i];
      const std::vector<double> heights = bed.heights();
      const std::string name = fmt::format("{}_{:g}", limit ? "limited" : "free", elapsed);
      table.names.push_back(name + "_d");
      table.columns.push_back(heights);
      write_data(script, name, {table.columns[0], heights, {}, {}});
      const double left = limit ? 0.55 : 0.06;
      script << panel_place(left, left + 0.43, 0.94 - 0.29 * i, 0.72 - 0.29 * i)
             << title(fmt::format("{} impacts per d; {}: wavelength {:.0f} d, nine tenths of the rises below "
                                  "{:.0f}{{/Symbol \\260}}",
                                  elapsed, limit ? "stoss kept to 10{/Symbol \\260}" : "stoss free",
                                  mean_wavelength(heights, parameters.bin_length),
                                  upslope_quantile(heights, parameters.bin_length, 0.9) * 180 / M_PI))
             << (limit ? "unset ylabel\n" : "set ylabel 'height [d]'\n")
             << (i == 2 ? "set xlabel 'along the wind, in grain diameters d; wind to the right'\nset format "
                          "x '%g'\n"
                        : "unset xlabel\nset format x ''\n")
             << "plot $" << name << " using 1:2 with filledcurves y=-50 fc rgb truth, $" << name
             << " using 1:2 with lines lw 1.2 lc rgb measured\n";
    }
  }
  script << "unset multiplot\n";
  write_csv(table, out + "/haff_profiles.csv");
  plot_svg(script.str(), 1300, 640, out + "/haff.svg");
}

}  // namespace aeolian
