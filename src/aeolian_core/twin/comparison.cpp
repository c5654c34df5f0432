#include "aeolian_core/twin/comparison.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_invoke.h>

#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/translation.hpp"

namespace aeolian {
namespace {

/// A layer with only the cells that are known in every surface compared.
HeightMap::Layer only(const HeightMap::Layer& values, const std::vector<bool>& known) {
  HeightMap::Layer result(values.size(), HeightMap::unknown);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (known[i]) result[i] = values[i];
  return result;
}

double skill(double rmse, double baseline) {
  if (baseline == 0) return rmse == 0 ? 0 : -INFINITY;
  return 1 - rmse * rmse / (baseline * baseline);
}

/// How far a pattern is looked for: beyond half a wavelength it meets itself again. A bed without ripples is
/// looked at within a tenth of its extent.
double search_range(const GridGeometry& geometry, double wavelength_measured, double wavelength_predicted) {
  for (const double wavelength : {wavelength_measured, wavelength_predicted})
    if (std::isfinite(wavelength)) return wavelength / 2;
  return std::max(geometry.length_x(), geometry.length_y()) / 10;
}

double volume_change(const GridGeometry& geometry, const DifferenceStatistics& since_start) {
  return since_start.bias * static_cast<double>(since_start.cells) * geometry.cell() * geometry.cell();
}

}  // namespace

Comparison compare(const GridGeometry& geometry, const HeightMap::Layer& predicted,
                   const HeightMap::Layer& measured, const HeightMap::Layer& initial, double direction) {
  for (const auto* layer : {&predicted, &measured, &initial})
    if (layer->size() != geometry.size())
      throw Error("comparison: a surface has " + std::to_string(layer->size()) + " cells, its grid has " +
                  std::to_string(geometry.size()));
  if (!std::isfinite(direction)) throw Error("comparison: the direction is not a finite number");
  std::vector<bool> known(geometry.size());
  for (std::size_t i = 0; i < known.size(); ++i)
    known[i] = std::isfinite(predicted[i]) && std::isfinite(measured[i]) && std::isfinite(initial[i]);
  const HeightMap::Layer forecast = only(predicted, known);
  const HeightMap::Layer truth = only(measured, known);
  const HeightMap::Layer start = only(initial, known);

  const DifferenceStatistics error = difference_statistics(forecast, truth);
  if (error.cells == 0) throw Error("comparison: no cell is known in forecast, measurement and start");
  const DifferenceStatistics change_measured = difference_statistics(truth, start);
  const DifferenceStatistics change_predicted = difference_statistics(forecast, start);

  Comparison result;
  result.cells = error.cells;
  result.bias = error.bias;
  result.rmse = error.rmse;
  result.nmad = error.nmad;
  result.volume_change_measured = volume_change(geometry, change_measured);
  result.volume_change_predicted = volume_change(geometry, change_predicted);

  RippleStatistics ripples_measured;
  RippleStatistics ripples_predicted;
  tbb::parallel_invoke([&] { ripples_measured = ripple_statistics(geometry, truth, direction); },
                       [&] { ripples_predicted = ripple_statistics(geometry, forecast, direction); });
  result.wavelength_measured = ripples_measured.wavelength;
  result.wavelength_predicted = ripples_predicted.wavelength;
  result.height_measured = ripples_measured.height;
  result.height_predicted = ripples_predicted.height;

  const double range = search_range(geometry, result.wavelength_measured, result.wavelength_predicted);
  const auto displacement = [&](const HeightMap::Layer& later, const DifferenceStatistics& change) {
    if (change.rmse == 0) return 0.0;
    return pattern_displacement(geometry, start, later, direction, range).value_or(NAN);
  };
  tbb::parallel_invoke(
      [&] { result.displacement_measured = displacement(truth, change_measured); },
      [&] { result.displacement_predicted = displacement(forecast, change_predicted); },
      [&] { result.rmse_translation = best_translation(geometry, start, truth, direction, range).rmse; });

  result.rmse_persistence = change_measured.rmse;
  result.skill_persistence = skill(error.rmse, result.rmse_persistence);
  result.skill_translation = skill(error.rmse, result.rmse_translation);
  return result;
}

}  // namespace aeolian
