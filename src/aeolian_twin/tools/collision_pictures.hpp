#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "aeolian_core/bedforms/theory/merger_theory.hpp"
#include "aeolian_core/bedforms/theory/ripple_collision.hpp"
#include "aeolian_core/twin/gnuplot.hpp"
#include "aeolian_core/twin/plot_data.hpp"
#include "aeolian_twin/tools/theory_tables.hpp"

namespace aeolian {

/// Of the triangular ripples in the thesis [rad].
/// @{
constexpr double thesis_stoss_angle = 5 * M_PI / 180;
constexpr double thesis_impact_angle = 10 * M_PI / 180;
/// @}

/// The outline of a pair of triangles, for drawing: (x, height) from its upwind to its downwind foot.
inline Curve outline(const RipplePair& pair) {
  const double stoss = 1 / std::tan(thesis_stoss_angle);
  const double lee = 1 / std::tan(thesis_impact_angle);
  const double apex = pair.upstream * stoss;
  const double meeting = apex + pair.effective_height() * lee;
  const double second = meeting + (pair.downstream - pair.overlap) * stoss;
  return {{0, apex, meeting, second, second + pair.downstream * lee},
          {0, pair.upstream, pair.overlap, pair.downstream, 0},
          {},
          {}};
}

/// Five states of a collision, at even steps of the upstream ripple's height.
inline std::vector<RipplePair> stages(const Collision& collision) {
  std::vector<RipplePair> result;
  for (int i = 0; i < 5; ++i) {
    const double height =
        collision.before().upstream + i / 4.0 * (collision.after().upstream - collision.before().upstream);
    const auto closer = [&](const RipplePair& a, const RipplePair& b) {
      return std::abs(a.upstream - height) < std::abs(b.upstream - height);
    };
    result.push_back(*std::min_element(collision.course.begin(), collision.course.end(), closer));
  }
  return result;
}

/// Writes the outlines of a collision as data blocks; the result is the command that draws them, the first on
/// top.
inline std::string stages_panel(std::ostream& data, EjectionLaw ejection, const std::string& name) {
  constexpr double distance = 1.25;
  std::string plot = "plot ";
  const std::vector<RipplePair> drawn = stages(collide(0.5, ejection));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double base = distance * static_cast<double>(drawn.size() - 1 - i);
    Curve curve = outline(drawn[i]);
    for (double& y : curve.y) y += base;
    write_data(data, name + std::to_string(i), curve);
    plot += fmt::format(
        "{}${}{} using 1:2 with filledcurves y={} fc rgb truth notitle, ${}{} using 1:2 with "
        "lines lw 1.3 lc rgb measured notitle",
        i == 0 ? "" : ", ", name, i, base, name, i);
  }
  return plot + "\n";
}

/// Writes collisions.csv and collisions.svg: what target and brink ejection make of a pair, by the ratio of
/// its heights.
inline void draw_collisions(const std::string& out) {
  std::vector<std::vector<double>> rows;
  for (int percent = 20; percent <= 98; percent += 2) {
    const double ratio = percent / 100.0;
    const Collision target = collide(ratio, EjectionLaw::target);
    const Collision brink = collide(ratio, EjectionLaw::brink);
    rows.push_back({ratio, target.after().upstream, target.after().downstream,
                    target.least_effective_height(), brink.after().upstream, brink.after().downstream,
                    brink.least_effective_height()});
  }
  const Table table = table_of(
      {"ratio_before", "target_upstream_after", "target_downstream_after", "target_least_effective_height",
       "brink_upstream_after", "brink_downstream_after", "brink_least_effective_height"},
      rows);
  write_csv(table, out + "/collisions.csv");

  std::ostringstream script;
  script << plot_style;
  write_block(script, "outcome", table);
  const std::string target = stages_panel(script, EjectionLaw::target, "target");
  const std::string brink = stages_panel(script, EjectionLaw::brink, "brink");
  script << "set multiplot\nunset key\nset border 0\nunset ytics\nunset xtics\nset yrange [-0.2:6.2]\n"
            "set xrange [0:27.5]\n"
         << panel_place(0.02, 0.25, 0.88, 0.17) << "set xlabel 'from top to bottom; wind to the right'\n"
         << title("Target ejection exchanges sizes 0.5 and 1") << target
         << panel_place(0.28, 0.51, 0.88, 0.17) << title("Brink ejection evens them") << brink
         << "set border 3\nset xtics nomirror out\nset ytics nomirror out\nset xlabel 'smaller / larger "
            "before'\n"
            "set xrange [0.2:1]\nset yrange [0:1.05]\n"
         << panel_place(0.57, 0.765, 0.88, 0.17) << title("Heights after / larger before")
         << "set key bottom right samplen 1.5 reverse Left\nplot "
            "$outcome using 1:2 with lines lw 2 lc rgb second title 'upstream, target', "
            "$outcome using 1:3 with lines lw 2 dt 2 lc rgb second title 'downstream, target', "
            "$outcome using 1:5 with lines lw 2 lc rgb forecast title 'upstream, brink', "
            "$outcome using 1:6 with lines lw 2 dt 2 lc rgb forecast title 'downstream, brink'\n"
         << panel_place(0.80, 0.99, 0.88, 0.17) << title("Least effective height / smaller")
         << "plot $outcome using 1:4 with lines lw 2 lc rgb second title 'target', "
            "$outcome using 1:7 with lines lw 2 lc rgb forecast title 'brink'\nunset multiplot\n";
  plot_svg(script.str(), 1300, 430, out + "/collisions.svg");
}

/// Writes limiting_wavelengths.csv and .svg: the longest ripples that still merge (fig. 5.24).
inline void draw_limiting_wavelengths(const std::string& out) {
  constexpr double hop = 0.04;
  constexpr double grain = 0.001;
  const TriangularRipple shape(thesis_stoss_angle, thesis_impact_angle);
  std::vector<std::vector<double>> rows;
  for (int percent = 30; percent <= 98; percent += 2) {
    const double ratio = percent / 100.0;
    const LimitingWavelength overshoot =
        limiting_wavelength(shape, ratio, overshoot_height(hop, thesis_impact_angle));
    const LimitingWavelength shearing = limiting_wavelength(shape, ratio, shearing_height(grain));
    rows.push_back({ratio, overshoot.smaller, overshoot.merged(), shearing.smaller, shearing.merged()});
  }
  const Table table = table_of({"ratio_before", "overshoot_smaller_m", "overshoot_merged_m",
                                "shearing_smaller_m", "shearing_merged_m"},
                               rows);
  write_csv(table, out + "/limiting_wavelengths.csv");
  std::ostringstream script;
  script << plot_style;
  write_block(script, "limit", table);
  script
      << "set tmargin at screen 0.84\nset key top right samplen 2 reverse Left\n"
         "set xlabel 'smaller / larger of the pair'\nset ylabel 'wavelength [cm]'\nset yrange [0:60]\n"
         "set xrange [0.3:1]\n"
      << "set label 1 'Longest ripples that still merge; grains of 1 mm, hops of 4 cm, stoss 5{/Symbol "
         "\\260}, "
         "impacts 10{/Symbol \\260}' at graph 0, graph 1.12 left textcolor rgb measured\n"
      << "set label 2 'observed for such sand: about 20 cm' at 0.49, 21.8 left textcolor rgb baseline\n"
      << "plot 20 with lines lw 1.5 dt 3 lc rgb baseline notitle, "
         "$limit using 1:($3*100) with lines lw 2.5 lc rgb second title 'merged, hops overshoot the shadow', "
         "$limit using 1:($2*100) with lines lw 1.5 dt 2 lc rgb second title 'smaller of that pair', "
         "$limit using 1:($5*100) with lines lw 2.5 lc rgb forecast title 'merged, apex sheared off by "
         "chance', "
         "$limit using 1:($4*100) with lines lw 1.5 dt 2 lc rgb forecast title 'smaller of that pair'\n";
  plot_svg(script.str(), 760, 480, out + "/limiting_wavelengths.svg");
}

}  // namespace aeolian
