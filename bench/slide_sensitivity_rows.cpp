#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "slide_rows.hpp"
#include <tbb/parallel_for.h>

#include "aeolian_core/slide/calibration/snow_calibration.hpp"
#include "aeolian_core/slide/piles/slide_series.hpp"

namespace aeolian {
namespace {

constexpr int events = 3;
constexpr std::size_t seeds = 4;

struct Change {
  const char* name;
  double SnowLaw::*number;
  double nominal, altered;
};
/// The thesis' pairs, section 3.3.
constexpr Change changes[] = {{"M", &SnowLaw::friction, 0.3, 0.6},
                              {"beta", &SnowLaw::cohesion, 0.15, 0.3},
                              {"p0", &SnowLaw::consolidation, 3000, 6000},
                              {"xi", &SnowLaw::hardening, 0.1, 0.2},
                              {"E", &SnowLaw::youngs_modulus, 1e6, 2e6}};
constexpr std::size_t groups = 1 + std::size(changes);

SlideScene scene_of(std::size_t group, std::uint64_t seed) {
  SlideScene scene;
  scene.cell = scene.slab_thickness / 2;
  scene.panel_height = 0.5;
  scene.threads = 1;
  scene.seed = seed;
  for (const Change& c : changes) scene.snow.*c.number = c.nominal;
  if (group > 0) scene.snow.*changes[group - 1].number = changes[group - 1].altered;
  return scene;
}

/// Height and length after each event, means over seeds.
struct Means {
  double height[events] = {};
  double length[events] = {};
};

}  // namespace

void slide_sensitivity_rows(AccuracyTable& table) {
  table.section(
      "Sensitivity, two dimensions",
      "Specification, section 5 C: panel at 0.5 m, 40 degrees, three events, T/dx = 2, each number twice its "
      "nominal one, means of four seeds (the thesis has three dimensions). S is the relative change of the "
      "result over that of the number; figures are those after events 1, 2 and 3.");
  std::vector<std::vector<PileSize>> piles(groups * seeds);
  tbb::parallel_for(std::size_t{0}, piles.size(), [&](std::size_t k) {
    SlideSeries<2> series(scene_of(k / seeds, 1 + k % seeds));
    for (int e = 0; e < events; ++e) piles[k].push_back(series.next()->pile);
  });
  std::vector<Means> means(groups);
  for (std::size_t k = 0; k < piles.size(); ++k)
    for (std::size_t e = 0; e < events; ++e) {
      means[k / seeds].height[e] += piles[k][e].height / seeds;
      means[k / seeds].length[e] += piles[k][e].length / seeds;
    }
  double height[std::size(changes)][events], length[std::size(changes)][events];
  for (std::size_t c = 0; c < std::size(changes); ++c)
    for (int e = 0; e < events; ++e) {
      const Change& change = changes[c];
      height[c][e] =
          sensitivity_index(means[0].height[e], means[c + 1].height[e], change.nominal, change.altered);
      length[c][e] =
          sensitivity_index(means[0].length[e], means[c + 1].length[e], change.nominal, change.altered);
    }
  const auto told = [](const double(&s)[events]) {
    return fmt::format("{:+.2f}, {:+.2f}, {:+.2f}", s[0], s[1], s[2]);
  };
  const auto all = [](const double(&s)[events], int first, double sign) {
    bool holds = true;
    for (int e = first; e < events; ++e) holds = holds && sign * s[e] > 0;
    return holds;
  };
  const auto largest = [](const double(&s)[events]) {
    double most = 0;
    for (const double v : s) most = std::max(most, std::abs(v));
    return most;
  };
  table.statement("M raises the height", told(height[0]), all(height[0], 0, 1));
  table.statement("M shortens the pile", told(length[0]), all(length[0], 0, -1));
  table.statement("beta raises the height", told(height[1]), all(height[1], 0, 1));
  table.statement("beta shortens the pile from event 2 on", told(length[1]), all(length[1], 1, -1));
  table.statement("beta's S of the height grows with events", told(height[1]),
                  height[1][0] < height[1][1] && height[1][1] < height[1][2]);
  table.statement("p0 changes the height less than M or beta (ours, not the thesis')", told(height[2]),
                  largest(height[2]) < std::max(largest(height[0]), largest(height[1])));
  table.statement("p0 lengthens the pile at events 1 and 2", told(length[2]),
                  length[2][0] > 0 && length[2][1] > 0);
  const double most = std::max(largest(height[0]), largest(height[1]));
  table.range_row("largest size of S of xi on the height, over that of M and beta", 0, 1. / 3,
                  largest(height[3]) / most);
  table.range_row("largest size of S of E on the height, over that of M and beta", 0, 1. / 3,
                  largest(height[4]) / most);
  int larger = 0;
  for (std::size_t c = 0; c < std::size(changes); ++c)
    larger += largest(height[c]) > largest(length[c]) ? 1 : 0;
  table.range_row("numbers of five whose largest S is of the height, not the length", 5, 5, larger);
}

}  // namespace aeolian
