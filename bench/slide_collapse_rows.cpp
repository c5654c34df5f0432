#include <algorithm>
#include <cmath>

#include "slide_rows.hpp"

#include "aeolian_core/slide/mpm/snow_body.hpp"
#include "aeolian_core/slide/piles/pile_measure.hpp"

namespace aeolian {
namespace {

constexpr double friction_angle = 33 * M_PI / 180;
constexpr double base = 0.1;  ///< half width of the column [m]
constexpr double cells = 20;  ///< of the grid in that

struct Deposit {
  double run_out, height;  ///< over the column's half width
};

/// Half of a column between a smooth plane of symmetry and rough ground.
Deposit collapse(double aspect) {
  SnowLaw sand;
  sand.yield = SnowLaw::Yield::drucker_prager;
  sand.density = 1600;
  sand.friction = SnowLaw::friction_of_angle(friction_angle, 2);
  MpmSettings settings;
  settings.threads = 1;
  settings.cell = base / cells;
  const auto plane = [](int axis) {
    return std::make_shared<HalfSpace<2>>(Point<2>::Zero(), Point<2>::Unit(axis));
  };
  MaterialPoints<2> world(
      settings, sand,
      {{plane(0), Contact::slip, 0, Point<2>::Zero()}, {plane(1), Contact::sticky, 0, Point<2>::Zero()}});
  world.add(filled_box<2>({Point<2>::Zero(), Eigen::Matrix2d::Identity(), {base, aspect * base}}, sand,
                          settings.cell, 4, 0.1, 1));
  const double fall = std::sqrt(aspect * base / 9.81);
  while (world.time() < 2 * fall || (world.fastest() > 0.01 && world.time() < 10 * fall)) world.advance(0.02);
  std::vector<Point<2>> places;
  for (const auto& p : world.points()) places.push_back(p.place);
  PileRules rules;
  rules.link = 2 * settings.cell;
  rules.trimmed = 0;
  rules.cells = 300;
  const PileSize pile = measure_pile<2>(places, rules);
  return {(pile.tail - base) / base, pile.height / base};
}

}  // namespace

void slide_collapse_rows(AccuracyTable& table) {
  table.section(
      "Collapse of columns",
      "Drucker-Prager, 33 degrees, not fitted to each; rough ground, plane strain, 20 cells in the half "
      "width. "
      "Targets: Lube et al. (2005) for columns in a channel, run-out over half width 1.2 a up to a = 1.8, "
      "1.9 a^(2/3) above; height over half width a up to a = 1.15, a^0.4 above. Lajeunesse et al. (2005) "
      "find the same powers for the run-out, and a^(1/3) for the height. (Lube 2004 is of round columns.)");
  for (const double a : {0.5, 1., 2., 4.}) {
    const Deposit ours = collapse(a);
    table.relative_row(fmt::format("a = {:g}: run-out over half width", a),
                       a < 1.8 ? 1.2 * a : 1.9 * std::pow(a, 2. / 3), ours.run_out, 0.08);
    table.relative_row(fmt::format("a = {:g}: height over half width", a), a < 1.15 ? a : std::pow(a, 0.4),
                       ours.height, 0.08);
    if (a > 1) table.remark(fmt::format("a = {:g}: height after Lajeunesse", a), std::cbrt(a), ours.height);
  }
}

}  // namespace aeolian
