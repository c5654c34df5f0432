#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "slide_rows.hpp"
#include <tbb/parallel_for.h>

#include "aeolian_core/slide/calibration/snow_calibration.hpp"
#include "aeolian_core/slide/piles/slide_series.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr int events = 2;
constexpr double tilts_deg[] = {40, 50};
constexpr double reading = 0.005;  ///< standard deviation of the laboratory's errors [m]
constexpr SnowSet truth{0.5, 7000, 0.2, 0.7};

/// Piles of both tilts after each event.
std::vector<std::optional<PileSize>> piles_of(const SnowSet& set, std::uint64_t seed) {
  std::vector<std::optional<PileSize>> piles;
  for (const double tilt : tilts_deg) {
    SlideScene scene;
    scene.cell = scene.slab_thickness / 2;
    scene.tilt = tilt * M_PI / 180;
    scene.threads = 1;
    scene.seed = seed;
    SlideSeries<2> series(with_snow(scene, set));
    for (int e = 0; e < events; ++e) piles.emplace_back(series.next()->pile);
  }
  return piles;
}

std::vector<LabPile> read_with_errors(const std::vector<std::optional<PileSize>>& piles, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<LabPile> lab;
  for (std::size_t k = 0; k < piles.size(); ++k)
    lab.push_back({tilts_deg[k / events] * M_PI / 180, static_cast<int>(k % events) + 1,
                   piles[k]->height + reading * random.normal(),
                   piles[k]->length + reading * random.normal()});
  return lab;
}

/// At most one step of each list away.
bool is_neighbour(const SnowGrid& grid, const SnowSet& set) {
  const auto step = [](const std::vector<double>& values, double a, double b) {
    const auto place = [&](double v) { return std::find(values.begin(), values.end(), v) - values.begin(); };
    return std::abs(place(a) - place(b));
  };
  return step(grid.friction, set.friction, truth.friction) +
             step(grid.consolidation, set.consolidation, truth.consolidation) +
             step(grid.cohesion, set.cohesion, truth.cohesion) <=
         1;
}

}  // namespace

void slide_calibration_rows(AccuracyTable& table) {
  table.section(
      "Calibration",
      "Specification, section 5 A: the thesis' grid of 48 sets on ten pseudo-laboratories of M 0.5, p0 7 "
      "kPa, beta "
      "0.2, friction 0.7. All ten are one simulation, made with other random places of the particles than "
      "the "
      "grid's, with 5 mm of reading error drawn anew; 40 and 50 degrees, two events, two dimensions, T/dx = "
      "2 (the "
      "thesis has five events in three dimensions; its laboratory is only in its figures, so errors here are "
      "against the pseudo-laboratory). A neighbour is one step of one list away.");
  const SnowGrid grid;
  const std::vector<SnowSet> sets = sets_of(grid);
  std::vector<std::vector<std::optional<PileSize>>> simulated(sets.size());
  tbb::parallel_for(std::size_t{0}, sets.size(), [&](std::size_t k) { simulated[k] = piles_of(sets[k], 1); });
  const auto laboratory = piles_of(truth, 2);
  int found = 0, near = 0;
  double height_error = 0, length_error = 0, rmse_height = 0, rmse_length = 0;
  double spread_height = 0, spread_length = 0;
  constexpr int trials = 10;
  for (int trial = 0; trial < trials; ++trial) {
    const auto lab = read_with_errors(laboratory, 100 + static_cast<std::uint64_t>(trial));
    std::vector<PileErrors> errors;
    for (const auto& piles : simulated) errors.push_back(errors_against(lab, piles));
    const auto result =
        calibrate(grid, 0, [&](const std::vector<SnowSet>&) { return std::optional(errors); });
    const SnowSet& best = result->best.set;
    found += best.friction == truth.friction && best.consolidation == truth.consolidation &&
                     best.cohesion == truth.cohesion
                 ? 1
                 : 0;
    near += is_neighbour(grid, best) ? 1 : 0;
    double height = 0, length = 0;
    for (const LabPile& pile : lab) {
      height += pile.height / static_cast<double>(lab.size());
      length += pile.length / static_cast<double>(lab.size());
    }
    height_error += result->best.errors.height / height / trials;
    length_error += result->best.errors.length / length / trials;
    rmse_height += result->best.errors.height / trials;
    rmse_length += result->best.errors.length / trials;
    const auto spread = [&](double PileErrors::*which) {
      const auto ends = std::minmax_element(
          errors.begin(), errors.end(), [&](const auto& a, const auto& b) { return a.*which < b.*which; });
      return (*ends.second).*which / (*ends.first).*which / trials;
    };
    spread_height += spread(&PileErrors::height);
    spread_length += spread(&PileErrors::length);
  }
  table.range_row("set or a neighbour found, of 10 laboratories", 9, 10, near);
  table.remark("the very set found, of 10", 10, found);
  table.range_row("error of the height of the best set, over the mean height", 0, 0.1, height_error);
  table.range_row("error of the length, over the mean length", 0, 0.2, length_error);
  table.range_row("root mean square error of the height [m]", 0, 0.017, rmse_height);
  table.range_row("root mean square error of the length [m]", 0, 0.08, rmse_length);
  table.range_row("worst over best error of the height, of 48 sets", 4, 1e3, spread_height);
  table.range_row("worst over best error of the length, of 48 sets", 2.5, 1e3, spread_length);
}

}  // namespace aeolian
