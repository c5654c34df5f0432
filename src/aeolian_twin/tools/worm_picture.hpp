#pragma once

#include <cmath>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/bedforms/theory/independent_members.hpp"
#include "aeolian_core/bedforms/theory/worm_model.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/tools/theory_tables.hpp"

namespace aeolian {

/// Mean and spread of lengths over time, from four rings.
inline Table worm_growth(std::uint64_t seed) {
  constexpr int rings = 4;
  std::vector<std::int64_t> times;
  for (double exponent = 0; exponent < 5.5; exponent += 0.1)
    times.push_back(std::llround(std::pow(10, exponent)));
  const auto growths = run_members(rings, [&](int ring) {
    return grow_worms(WormRing(1000, 2, 0.5, seed, static_cast<std::uint64_t>(ring)), times);
  });
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double mean = 0;
    double deviation = 0;
    for (const auto& growth : growths) {
      mean += growth[i].mean_length / rings;
      deviation += growth[i].deviation / rings;
    }
    rows.push_back({static_cast<double>(times[i]), mean, deviation});
  }
  return table_of({"steps", "mean_length", "standard_deviation"}, rows);
}

/// Mergers of two worms of five links, by the chain and by play, over the pace.
inline Table worm_pairs(std::uint64_t seed) {
  constexpr int members = 10000;
  std::vector<std::vector<double>> rows;
  for (int percent = 20; percent <= 100; percent += 10) {
    const double pace = percent / 100.0;
    const std::int64_t steps = std::llround(250 / pace);
    const double exact = merger_probability(5, 5, pace, steps);
    const double played = static_cast<double>(count_mergers(5, 5, pace, steps, members,
                                                            seed + static_cast<std::uint64_t>(percent))) /
                          members;
    rows.push_back({pace, exact, played, std::sqrt(exact * (1 - exact) / members)});
  }
  return table_of({"pace", "chain", "play", "standard_error"}, rows);
}

/// Writes worm_growth.csv, worm_pairs.csv and worms.svg.
inline void draw_worms(const std::string& out, std::uint64_t seed) {
  const Table growth = worm_growth(seed);
  const Table pairs = worm_pairs(seed);
  write_csv(growth, out + "/worm_growth.csv");
  write_csv(pairs, out + "/worm_pairs.csv");
  const double last = growth.column("mean_length").back() - std::log(growth.column("steps").back());
  std::ostringstream script;
  script << plot_style;
  write_block(script, "growth", growth);
  write_block(script, "pairs", pairs);
  script
      << "set multiplot\n"
      << panel_place(0.07, 0.56, 0.88, 0.14) << title("Worms on a ring, from 2 links, pace 0.5")
      << "set logscale x\nset format x '10^{%L}'\nset xrange [1:3e5]\nset yrange [0:16]\nset xlabel 'steps'\n"
         "set ylabel 'links'\nset key top left samplen 2 reverse Left\nplot "
         "$growth using 1:($2-$3):($2+$3) with filledcurves fc rgb truth fs transparent solid 0.5 title "
         "'standard deviation of lengths', "
         "$growth using 1:2 with lines lw 2.5 lc rgb measured title 'mean length', "
      << fmt::format("[100:3e5] {} + log(x) with lines lw 1.5 dt 2 lc rgb second title 'ln(steps) + const'\n",
                     last)
      << "unset logscale x\nset format x '%g'\n"
      << panel_place(0.66, 0.98, 0.88, 0.14) << title("Two worms of 5 links merge within 250 / pace steps")
      << "set xrange [0.15:1.05]\nset yrange [0:*]\nset xlabel 'pace'\nset ylabel 'probability'\n"
         "set key top right\nplot $pairs using 1:2 with lines lw 2 lc rgb second title 'Markov chain', "
         "$pairs using 1:3:(2*$4) with yerrorbars pt 7 ps 0.6 lc rgb forecast title '10 000 pairs, 2 s.d.'\n"
         "unset multiplot\n";
  plot_svg(script.str(), 1100, 430, out + "/worms.svg");
}

}  // namespace aeolian
