#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "slide_rows.hpp"

#include "aeolian_core/slide/piles/slide_series.hpp"

namespace aeolian {
namespace {

SlideScene lab(double tilt_deg, double cells) {
  SlideScene scene;
  scene.tilt = tilt_deg * M_PI / 180;
  scene.cell = scene.slab_thickness / cells;
  scene.threads = 1;
  return scene;
}

std::vector<PileSize> piles_of(const SlideScene& scene, int events) {
  SlideSeries<2> series(scene);
  std::vector<PileSize> piles;
  for (int k = 0; k < events; ++k) piles.push_back(series.next()->pile);
  return piles;
}

/// Over seeds.
struct Mean {
  double value = 0, error = 0;
};

Mean mean_of(const std::vector<PileSize>& piles, double PileSize::*what) {
  Mean mean;
  const auto count = static_cast<double>(piles.size());
  for (const PileSize& p : piles) mean.value += p.*what / count;
  for (const PileSize& p : piles) mean.error += std::pow(p.*what - mean.value, 2);
  mean.error = std::sqrt(mean.error / (count * (count - 1)));
  return mean;
}

/// The last of some events, for the seeds from 1; and the processor time of one of them [s].
std::vector<PileSize> over_seeds(SlideScene scene, int events, int seeds, double* seconds = nullptr) {
  const std::clock_t start = std::clock();
  std::vector<PileSize> piles;
  for (int seed = 1; seed <= seeds; ++seed) {
    scene.seed = static_cast<std::uint64_t>(seed);
    piles.push_back(piles_of(scene, events).back());
  }
  if (seconds) *seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / seeds;
  return piles;
}

/// What the thickness in cells costs, and what it gives: the first event on the laboratory's panel.
void convergence(AccuracyTable& table) {
  table.section(
      "Cells per thickness of the slab: run time against error",
      "First event on the laboratory's panel at 40 degrees, friction 0.7, two dimensions, six seeds "
      "(they move the particles of the fresh slab by a fifth of their spacing). Targets: the finest. "
      "The thesis' calibration has 2, its geometry study 5. From T/dx = 4 on the slab may end in two "
      "ways: flat, 0.03 m high, or broken with one piece upon another, 0.06 to 0.08 m high. Which one "
      "is chance; coarser cells know the first only. Single runs tell little, and means over six are "
      "not converged.");
  struct Row {
    std::string name;
    Mean height, length;
    double seconds;
  };
  std::vector<Row> rows;
  const auto add = [&](double cells, Transfer transfer) {
    SlideScene scene = lab(40, cells);
    scene.transfer = transfer;
    Row row;
    const auto piles = over_seeds(scene, 1, 6, &row.seconds);
    row.name = fmt::format("T/dx = {:g}, {}", cells, transfer == Transfer::apic ? "APIC" : "FLIP 0.99");
    row.height = mean_of(piles, &PileSize::height);
    row.length = mean_of(piles, &PileSize::length);
    rows.push_back(row);
  };
  add(2, Transfer::flip);
  for (const double cells : {2., 3., 4., 6.}) add(cells, Transfer::apic);
  const Row finest = rows.back();
  for (const Row& row : rows) {
    table.remark(fmt::format("{}: height [m]; {:.2g} s of processor time", row.name, row.seconds),
                 finest.height.value, row.height.value, row.height.error);
    table.remark(fmt::format("{}: length [m]", row.name), finest.length.value, row.length.value,
                 row.length.error);
  }
}

/// The same event as the thesis has it: in three dimensions, on cells of 1 cm.
void three_dimensions(AccuracyTable& table) {
  table.section(
      "Laboratory, three dimensions",
      "First event at 40 degrees, T/dx = 2 (the thesis' cells), friction 0.7, six particles a cell, one "
      "seed. Frischholz' piles of five events are about 0.10 m high and 0.30 m long on average "
      "(specification, section 5 A). Section 5 D: a pile in three dimensions is 2/3 as high as in two "
      "where it is as wide as high, and as high where it is wide. This one is four times as wide as "
      "high.");
  SlideScene scene = lab(40, 2);
  const auto slices = over_seeds(scene, 1, 6);
  scene.particles_per_cell = 6;
  const std::clock_t start = std::clock();
  const auto event = SlideSeries<3>(scene).next();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const Mean height = mean_of(slices, &PileSize::height), length = mean_of(slices, &PileSize::length);
  table.range_row("height in three dimensions over that in two", 2. / 3, 1, event->pile.height / height.value,
                  height.error / height.value);
  table.remark(fmt::format("height [m], beside that in two dimensions; {:.2g} s of processor time", seconds),
               height.value, event->pile.height);
  table.remark("length [m], beside that in two dimensions", length.value, event->pile.length);
  table.remark("head [m], beside that in two dimensions", mean_of(slices, &PileSize::head).value,
               event->pile.head);
}

void trends(AccuracyTable& table) {
  table.section(
      "Laboratory, two dimensions",
      "Specification, section 5 B: three events, T/dx = 3, friction 0.7. The thesis' own figures are of "
      "three dimensions. A block leaves the panel with its whole speed and lands at 50 degrees farther "
      "than at 40 above a friction of 0.66 to 0.71; a slab covers the panel, so its front leaves at "
      "once, at no speed, and lands below the lower edge, which at 40 degrees is farther out.");
  const auto at_40 = piles_of(lab(40, 3), 3);
  const auto at_50 = piles_of(lab(50, 3), 3);
  const auto list = [](const std::vector<PileSize>& piles, double PileSize::*what) {
    std::string text;
    for (const PileSize& p : piles) text += fmt::format("{}{:.3f}", text.empty() ? "" : ", ", p.*what);
    return text;
  };
  const auto falls = [](const std::vector<PileSize>& p) {
    return p[0].head >= p[1].head && p[1].head >= p[2].head;
  };
  const auto grows = [](const std::vector<PileSize>& p) {
    return p[0].height < p[1].height && p[1].height < p[2].height;
  };
  table.statement("height grows with every event, 40 degrees [m]", list(at_40, &PileSize::height),
                  grows(at_40));
  table.statement("height grows with every event, 50 degrees [m]", list(at_50, &PileSize::height),
                  grows(at_50));
  table.statement("head advances towards the panel, 40 degrees [m]", list(at_40, &PileSize::head),
                  falls(at_40));
  table.statement("head advances towards the panel, 50 degrees [m]", list(at_50, &PileSize::head),
                  falls(at_50));
  table.range_row("tail after event 1, change over length, 40 degrees", 0, 0.25,
                  std::abs(at_40.back().tail - at_40[0].tail) / at_40.back().length);
  for (const double friction : {0.7, 0.8}) {
    const auto heads = [&](double tilt_deg) {
      SlideScene scene = lab(tilt_deg, 2);
      scene.panel_friction = friction;
      return mean_of(over_seeds(scene, 2, 4), &PileSize::head);
    };
    const Mean near = heads(40), far = heads(50);
    table.statement(
        fmt::format("head at 40 degrees is nearer than at 50, friction {:g}, two events, T/dx = 2 [m]",
                    friction),
        fmt::format("{:.3f} ± {:.3f}, {:.3f} ± {:.3f}", near.value, near.error, far.value, far.error),
        near.value < far.value);
  }
  const auto edge = [](double tilt_deg) {
    const SlideScene scene = lab(tilt_deg, 2);
    return 0.5 * scene.panel_length * std::cos(scene.tilt);
  };
  table.remark("lower edge of the panel at 40 degrees, and at 50 (target) [m]", edge(50), edge(40));
}

}  // namespace

void slide_pile_rows(AccuracyTable& table) {
  convergence(table);
  three_dimensions(table);
  trends(table);
}

}  // namespace aeolian
