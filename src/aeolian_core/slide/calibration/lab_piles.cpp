#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "aeolian_core/slide/calibration/snow_calibration.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

SlideScene with_snow(SlideScene scene, const SnowSet& set) {
  scene.snow.friction = set.friction;
  scene.snow.consolidation = set.consolidation;
  scene.snow.cohesion = set.cohesion;
  scene.panel_friction = set.panel_friction;
  return scene;
}

std::vector<SnowSet> sets_of(const SnowGrid& grid) {
  std::vector<SnowSet> sets;
  for (const double friction : grid.friction)
    for (const double consolidation : grid.consolidation)
      for (const double cohesion : grid.cohesion)
        for (const double panel : grid.panel_friction)
          sets.push_back({friction, consolidation, cohesion, panel});
  if (sets.empty()) throw Error("calibration: a list of values is empty, must have at least one");
  return sets;
}

std::vector<LabPile> read_lab_piles(const std::string& file) {
  constexpr std::array<const char*, 4> names{"tilt_deg", "event", "height_m", "length_m"};
  const Table table = read_csv(file);
  for (const std::string& name : table.names)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(fmt::format("{}: column '{}' is not one of a table of the laboratory: {}", file, name,
                              fmt::join(names, ", ")));
  for (const char* name : names)
    if (!table.has(name)) throw Error(fmt::format("{}: there is no column '{}'", file, name));
  if (table.rows() == 0) throw Error(file + ": there are 0 piles, must be at least 1");
  std::vector<LabPile> piles;
  std::set<std::pair<double, int>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto value = [&](std::size_t column, double least, double most, const char* rule) {
      const double v = table.column(names[column])[row];
      const bool whole = column != 1 || v == std::floor(v);
      if (!(v >= least && v <= most && whole))
        throw Error(fmt::format("{}: row {}: {} is {}, must be {}", file, row + 1, names[column], v, rule));
      return v;
    };
    const double tilt = value(0, 1, 89, "from 1 to 89");
    const int event = static_cast<int>(value(1, 1, 1000, "a whole number from 1 to 1000"));
    if (!seen.insert({tilt, event}).second)
      throw Error(
          fmt::format("{}: row {}: event {} at {:g} degrees is there twice", file, row + 1, event, tilt));
    piles.push_back({tilt * M_PI / 180, event, value(2, 1e-6, 1e4, "above 0 and at most 1e4"),
                     value(3, 1e-6, 1e4, "above 0 and at most 1e4")});
  }
  return piles;
}

PileErrors errors_against(const std::vector<LabPile>& lab,
                          const std::vector<std::optional<PileSize>>& simulated) {
  PileErrors sum;
  for (std::size_t k = 0; k < lab.size(); ++k) {
    const PileSize pile = simulated[k].value_or(PileSize{});
    sum.height += std::pow(pile.height - lab[k].height, 2);
    sum.length += std::pow(pile.length - lab[k].length, 2);
  }
  const auto count = static_cast<double>(lab.size());
  return {std::sqrt(sum.height / count), std::sqrt(sum.length / count)};
}

}  // namespace aeolian
