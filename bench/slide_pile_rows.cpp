#include <algorithm>
#include <cmath>

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

/// What the thickness in cells costs: the first event on the laboratory's panel.
void convergence(AccuracyTable& table) {
  table.section("Cells per thickness of the slab",
                "First event on the laboratory's panel at 40 degrees, friction 0.7, two dimensions, means of "
                "two seeds. "
                "The thesis' calibration has 2, its geometry study 5.");
  struct Row {
    double cells, height, length, spread;
  };
  std::vector<Row> rows;
  for (const double cells : {2., 3., 4., 6.}) {
    std::vector<PileSize> seeds;
    for (const std::uint64_t seed : {1, 2}) {
      SlideScene scene = lab(40, cells);
      scene.seed = seed;
      seeds.push_back(piles_of(scene, 1)[0]);
    }
    rows.push_back({cells, 0.5 * (seeds[0].height + seeds[1].height),
                    0.5 * (seeds[0].length + seeds[1].length), std::abs(seeds[0].height - seeds[1].height)});
  }
  const Row& finest = rows.back();
  for (const Row& row : rows) {
    table.remark(fmt::format("T/dx = {:g}: height [m]; seeds differ by {:.4f}", row.cells, row.spread),
                 finest.height, row.height);
    table.remark(fmt::format("T/dx = {:g}: length [m]", row.cells), finest.length, row.length);
  }
}

void trends(AccuracyTable& table) {
  table.section("Laboratory, two dimensions",
                "Specification, section 5 B: three events, T/dx = 3, friction 0.7. The thesis' own figures "
                "are of three "
                "dimensions.");
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
  table.statement("head at 40 degrees is nearer than at 50 [m]",
                  fmt::format("{:.3f}, {:.3f}", at_40.back().head, at_50.back().head),
                  at_40.back().head < at_50.back().head);
}

}  // namespace

void slide_pile_rows(AccuracyTable& table) {
  convergence(table);
  trends(table);
}

}  // namespace aeolian
