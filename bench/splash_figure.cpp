#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "splash_rows.hpp"
#include "splash_sample.hpp"
#include <fmt/format.h>

#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr int draws = 4000;

struct Curve {
  const char *splash, *name, *style;
};
constexpr std::array<Curve, 8> curves{{
    {"werner", "Werner: rebound model, coarse-sand ejecta", "lc rgb '#d62728' lw 3"},
    {"coarse_sand", "Werner: coarse-sand experiment", "lc rgb '#ff7f0e' lw 3 dt (12,8)"},
    {"kok_renno", "Kok \\& Renno 2009", "lc rgb '#1f77b4' lw 3"},
    {"anderson_haff", "Anderson \\& Haff 1991", "lc rgb '#17becf' lw 3"},
    {"beladjine", "Beladjine 2007 (amplitude of sand)", "lc rgb '#2ca02c' lw 3"},
    {"laemmel", "Lämmel 2017", "lc rgb '#9467bd' lw 3"},
    {"ungar_haff", "Ungar \\& Haff 1987 (no rebound)", "lc rgb '#7f7f7f' lw 2 dt 2"},
    {"distribution_6", "Eq. 4.34, case 6", "lc rgb '#000000' lw 2 dt 2"},
}};

/// Rows of x, speed ratio and eps_iy of what rebounds, and ejecta of an event.
void print_data(const std::string& block, const Splash& splash, const std::vector<double>& values,
                bool speeds) {
  const double unit = std::sqrt(gravity * Grain{}.diameter);
  fmt::print("${} << EOD\n", block);
  for (const double value : values) {
    const Impact impact{(speeds ? value : 60) * unit, (speeds ? 12 : value) * degree};
    RandomStream random(1, 1);
    SplashEvent event;
    Sample ratio, upward, number;
    for (int i = 0; i < draws; ++i) {
      splash.sample(impact, random, event);
      number.add(static_cast<double>(event.ejecta.size()));
      if (!event.rebound) continue;
      ratio.add(event.rebound->velocity.norm() / impact.speed);
      upward.add(event.rebound->velocity.z() / impact.speed / std::sin(impact.angle));
    }
    if (ratio.count() > 0)
      fmt::print("{:g} {:.4f} {:.4f} {:.4f}\n", value, ratio.mean(), upward.mean(), number.mean());
    else
      fmt::print("{:g} NaN NaN {:.4f}\n", value, number.mean());
  }
  fmt::print("EOD\n");
}

void print_panel(char block, int column, const std::string& title, const std::string& x, const std::string& y,
                 const std::string& settings) {
  fmt::print("set title '{}'; set xlabel '{}'; set ylabel '{}'; {}\nplot ", title, x, y, settings);
  for (std::size_t i = 0; i < curves.size(); ++i)
    fmt::print("{}${}{} using 1:{} with lines {} notitle", i == 0 ? "" : ", ", block, i, column,
               curves[i].style);
  fmt::print("\n");
}

}  // namespace

void print_splash_figure() {
  std::vector<double> speeds, angles;
  for (double v = 10; v <= 160; v += 5) speeds.push_back(v);
  for (double a = 4; a <= 88; a += 2) angles.push_back(a);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto splash = splash_of(curves[i].splash, "fine_sand");
    print_data(fmt::format("s{}", i), *splash, speeds, true);
    print_data(fmt::format("a{}", i), *splash, angles, false);
  }
  fmt::print(
      "set terminal pngcairo size 1500,900 enhanced font 'DejaVu Sans,12'\n"
      "set multiplot layout 2,3 margins 0.05,0.98,0.25,0.9 spacing 0.07,0.14 "
      "title 'Splash functions on fine sand of 0.25 mm' font ',16'\n"
      "set grid xtics ytics lt 1 lw 1 lc rgb '#dddddd'; set border 3; set tics nomirror\n");
  const std::string speed = "impact speed / √(g d)", angle = "angle to the bed, degrees";
  print_panel('s', 2, "At 12 degrees", speed, "speed after / before (rebounds)",
              "set xrange [0:160]; set yrange [0:1]");
  print_panel('s', 3, "At 12 degrees", speed, "ε_{{iy}}: upward speed after / before", "set yrange [0:4]");
  print_panel('s', 4, "At 12 degrees", speed, "ejecta of an impact", "set yrange [0:10]");
  print_panel('a', 2, "At 60 √(g d)", angle, "speed after / before (rebounds)",
              "set xrange [0:90]; set yrange [0:1]");
  print_panel('a', 3, "At 60 √(g d)", angle, "ε_{{iy}}: upward speed after / before", "set yrange [0:4]");
  print_panel('a', 4, "At 60 √(g d)", angle, "ejecta of an impact", "set yrange [0:10]");
  fmt::print(
      "set origin 0,0; set size 1,0.18; set margins 0,0,0,0\n"
      "unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid\n"
      "set key center center horizontal maxcols 3 samplen 5 spacing 1.6 width 2 Left reverse\n"
      "set xrange [0:1]; set yrange [0:1]\nplot ");
  for (std::size_t i = 0; i < curves.size(); ++i)
    fmt::print("{}-1 with lines {} title '{}'", i == 0 ? "" : ", ", curves[i].style, curves[i].name);
  fmt::print("\nunset multiplot\n");
}

}  // namespace aeolian
