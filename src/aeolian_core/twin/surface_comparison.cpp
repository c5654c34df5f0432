#include "aeolian_core/twin/surface_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <tbb/parallel_for_each.h>
#include <tbb/parallel_invoke.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/twin/block_sums.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/line_match.hpp"
#include "aeolian_core/twin/line_spectra.hpp"
#include "aeolian_core/twin/orientation.hpp"
#include "aeolian_core/twin/translation.hpp"

namespace aeolian {
namespace {

constexpr double levels_per_sigma = 1.96;
constexpr Figure none{NAN, NAN};

void require_usable(const HeightMap& map, const GridGeometry& grid, const char* which) {
  if (!map.has(layer::elevation)) throw Error(std::string("comparison: ") + which + " has no elevation");
  if (map.geometry().nx() != grid.nx() || map.geometry().ny() != grid.ny())
    throw Error(std::string("comparison: ") + which + " has " + std::to_string(map.geometry().nx()) + " x " +
                std::to_string(map.geometry().ny()) + " cells, must be on a grid of " +
                std::to_string(grid.nx()) + " x " + std::to_string(grid.ny()));
}

void require_usable(const ComparisonSettings& settings) {
  if (!std::isfinite(settings.direction)) throw Error("comparison: the direction is not a finite number");
  for (const auto& sigma : {settings.sigma_a, settings.sigma_b})
    if (sigma && !(*sigma >= 0 && std::isfinite(*sigma)))
      throw Error("comparison: a standard deviation is " + std::to_string(*sigma) +
                  " m, must not be negative");
}

/// A surface where all surfaces are known, and what follows from its lines along the wind.
struct Surface {
  HeightMap::Layer elevation;
  Plane plane;  ///< that is taken off
  std::optional<DirectionalLines> lines;
  std::optional<LineSpectra> spectra;
  PatternFigures figures;
  double rms = 0;  ///< about its plane [m]
};

/// 2 sqrt(2) standard deviations about a plane, with the jackknife over eight strips along the wind, or, of
/// less than 16 lines, stretches along them.
Figure relief_height(const GridGeometry& grid, const HeightMap::Layer& elevation, const Plane& plane,
                     double direction, bool few_lines, double& rms) {
  constexpr std::size_t parts = 8;
  struct Part {
    double squares = 0, cells = 0;
  };
  std::array<Part, parts> of_part;
  const double turned = direction + (few_lines ? 0 : M_PI / 2);  // the way from part to part
  const double c = std::cos(turned);
  const double s = std::sin(turned);
  const double width = std::abs(c) * grid.nx() + std::abs(s) * grid.ny();
  Part all;
  for (int y = 0; y < grid.ny(); ++y) {
    const double py = y - 0.5 * (grid.ny() - 1);
    for (int x = 0; x < grid.nx(); ++x) {
      const float z = elevation[grid.index(x, y)];
      if (!std::isfinite(z)) continue;
      const double px = x - 0.5 * (grid.nx() - 1);
      const double above = static_cast<double>(z) - (plane.a + plane.b * px + plane.c * py);
      const double place = std::clamp((c * px + s * py) / width + 0.5, 0.0, 1 - 1e-9);
      Part& part = of_part[static_cast<std::size_t>(place * parts)];
      part.squares += above * above;
      part.cells += 1;
    }
  }
  for (const Part& part : of_part) {
    all.squares += part.squares;
    all.cells += part.cells;
  }
  rms = std::sqrt(all.squares / all.cells);
  const double height = 2 * std::sqrt(2.0) * rms;
  double sum = 0;
  double squares = 0;
  for (const Part& part : of_part) {
    const double off = 2 * std::sqrt(2 * (all.squares - part.squares) / (all.cells - part.cells)) - height;
    sum += off;
    squares += off * off;
  }
  const double variance = (parts - 1.0) / parts * (squares - sum * sum / parts);
  return {height, std::sqrt(std::max(0.0, variance))};
}

/// Lays planes under the surfaces: the same one where theirs differ by so little that the phase of a pattern
/// may be all of it, which would pull the match of two patterns.
void fit_planes(const GridGeometry& grid, const std::vector<Surface*>& surfaces) {
  Plane mean;
  for (Surface* surface : surfaces) {
    surface->plane = fit_plane(grid, surface->elevation);
    const double share = 1 / static_cast<double>(surfaces.size());
    mean.a += share * surface->plane.a;
    mean.b += share * surface->plane.b;
    mean.c += share * surface->plane.c;
  }
  constexpr double by_phase = 0.3;  // of the roughness, at the map's corners
  for (const Surface* surface : surfaces) {
    const double rise = 0.5 * (std::abs(surface->plane.b - mean.b) * grid.nx() +
                               std::abs(surface->plane.c - mean.c) * grid.ny());
    const double roughness = difference_statistics(surface->elevation).nmad;
    if (!(rise <= by_phase * roughness)) return;
  }
  for (Surface* surface : surfaces) {
    surface->plane.b = mean.b;
    surface->plane.c = mean.c;
  }
}

void measure(const GridGeometry& grid, double direction, Surface& surface) {
  surface.lines.emplace(grid, surface.elevation, surface.plane, direction);
  surface.spectra.emplace(*surface.lines);
  PatternFigures& figures = surface.figures;
  const double cell = grid.cell();
  const Figure lag = LineCorrelation(*surface.spectra, *surface.spectra).jackknifed(repeating_lag);
  figures.wavelength = {lag.value * cell, lag.sigma * cell};
  figures.height = relief_height(grid, surface.elevation, surface.plane, direction, surface.lines->count < 16,
                                 surface.rms);
  if (std::isnan(lag.value)) {
    figures.height = figures.index = figures.crest_normal = none;
    return;
  }
  const double index = figures.wavelength.value / figures.height.value;
  figures.index = {index, index * std::hypot(figures.wavelength.sigma / figures.wavelength.value,
                                             figures.height.sigma / figures.height.value)};
  figures.crest_normal = crest_normal(grid, surface.elevation, figures.wavelength.value, direction);
}

/// The wavelength to look for things with [samples]; NaN when neither surface has one.
double common_wavelength(const Surface& a, const Surface& b, double cell) {
  const double of_b = b.figures.wavelength.value;
  return (std::isfinite(of_b) ? of_b : a.figures.wavelength.value) / cell;
}

/// How far a pattern is looked for [samples]: beyond half a wavelength it meets itself again; without ripples
/// a tenth of the lines.
double search_range(double wavelength, const DirectionalLines& lines) {
  return std::isfinite(wavelength) ? wavelength / 2 : 0.1 * lines.length;
}

/// Whether two layers have the same value in every cell known to both.
bool equal(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](float u, float v) { return !(std::abs(u - v) > 0); });
}

Figure displacement(const Surface& earlier, const Surface& later, double wavelength, double cell) {
  if (equal(earlier.elevation, later.elevation)) return {0, 0};
  const double range = search_range(wavelength, *earlier.lines);
  const auto near = lag_of_best_match(LineCorrelation(*earlier.spectra, *later.spectra).curve(), range);
  if (!near) return none;
  const Figure lag = match_lines(*earlier.lines, *later.lines, *near);
  return {lag.value * cell, lag.sigma * cell};
}

/// Zero where it is known.
void clear_known(CrestDisplacement& field) {
  for (double& value : field.displacement)
    if (std::isfinite(value)) value = 0;
  if (std::isfinite(field.median)) field.median = field.spread = 0;
}

/// 1 - mse / mse of a baseline, over the cells known to both, with the standard error of that ratio. Against
/// a perfect baseline it is 0 when the forecast is perfect too and minus infinity otherwise.
Figure skill(const GridGeometry& grid, const HeightMap::Layer& error, const HeightMap::Layer& baseline) {
  double squares = 0;
  double of_baseline = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!std::isfinite(error[i] + baseline[i])) continue;
    squares += static_cast<double>(error[i]) * static_cast<double>(error[i]);
    of_baseline += static_cast<double>(baseline[i]) * static_cast<double>(baseline[i]);
  }
  if (of_baseline == 0) return {squares == 0 ? 0 : -INFINITY, NAN};
  const double ratio = squares / of_baseline;
  HeightMap::Layer excess(error.size());
  for (std::size_t i = 0; i < error.size(); ++i)
    excess[i] = error[i] * error[i] - static_cast<float>(ratio) * baseline[i] * baseline[i];
  const auto sums = block_sums<1>(grid, excess, [](double v) { return std::array<double, 1>{v}; });
  return {1 - ratio, std::sqrt(sums.variance_of_mean(0)) / (of_baseline / sums.cells())};
}

ForecastSkill forecast_skill(const GridGeometry& grid, const Surface& a, const Surface& b,
                             const Surface& start, double direction) {
  ForecastSkill result;
  const double wavelength = common_wavelength(a, b, grid.cell());
  result.migration_a = displacement(start, a, wavelength, grid.cell());
  result.migration_b = displacement(start, b, wavelength, grid.cell());
  const double range = search_range(wavelength, *b.lines) * grid.cell();
  const Translation best = best_translation(grid, start.elevation, b.elevation, direction, range);
  result.rmse_translation = best.rmse;
  HeightMap moved(GridGeometry(grid.origin_x() + best.shift * std::cos(direction),
                               grid.origin_y() + best.shift * std::sin(direction), grid.cell(), grid.nx(),
                               grid.ny()));
  moved.add(layer::elevation, start.elevation);
  const HeightMap::Layer error = difference(a.elevation, b.elevation);
  const HeightMap::Layer still = difference(start.elevation, b.elevation);
  const HeightMap::Layer translated = difference(
      best.shift == 0 ? start.elevation : resample(moved, grid).layer(layer::elevation), b.elevation);
  result.rmse_persistence = difference_statistics(still).rmse;
  result.persistence = skill(grid, error, still);
  result.translation = skill(grid, error, translated);
  return result;
}

/// Adds lod95 to a map of differences and says what it rests on.
std::string add_levels(HeightMap& map, const HeightMap& a, const HeightMap& b,
                       const ComparisonSettings& settings) {
  struct Variance {
    HeightMap::Layer own;
    const HeightMap::Layer* layer;
    std::string source;

    Variance(const HeightMap& of, const std::optional<double>& sigma, std::size_t cells)
        : layer(of.has(layer::variance) ? &of.layer(layer::variance) : &own),
          source(layer != &own ? "its variances"
                 : sigma       ? "a given standard deviation"
                               : "none, taken as exact") {
      if (layer == &own) own.assign(cells, static_cast<float>(std::pow(sigma.value_or(0), 2)));
    }
    Variance(const Variance&) = delete;
    Variance& operator=(const Variance&) = delete;
  };
  const bool known = a.has(layer::variance) || settings.sigma_a || b.has(layer::variance) || settings.sigma_b;
  if (known) {
    const Variance of_a(a, settings.sigma_a, map.geometry().size());
    const Variance of_b(b, settings.sigma_b, map.geometry().size());
    map.add(layer::lod95, level_of_detection(*of_a.layer, *of_b.layer));
    return "errors of the first surface: " + of_a.source + "; of the second: " + of_b.source;
  }
  HeightMap::Layer errors = map.layer(layer::difference);
  if (settings.stable != nullptr)
    for (std::size_t i = 0; i < errors.size(); ++i)
      if (!((*settings.stable)[i] > 0.5F)) errors[i] = HeightMap::unknown;
  const DifferenceStatistics statistics = difference_statistics(errors);
  if (statistics.cells < 16)
    throw Error("comparison: " + std::to_string(statistics.cells) +
                " cells of stable ground have a difference, at least 16 are needed");
  map.add(layer::lod95, static_cast<float>(levels_per_sigma * statistics.nmad));
  return settings.stable != nullptr
             ? "no variances: NMAD of the differences on stable ground"
             : "no variances, no stable ground: NMAD of all differences, which takes change for error";
}

/// How many cells err as one, seen where nothing changed.
void find_correlation(const ComparisonSettings& settings, SurfaceComparison& result) {
  const HeightMap::Layer& levels = result.map.layer(layer::lod95);
  HeightMap::Layer errors = result.map.layer(layer::difference);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const bool quiet =
        settings.stable != nullptr ? (*settings.stable)[i] > 0.5F : std::abs(errors[i]) <= levels[i];
    if (!quiet) errors[i] = HeightMap::unknown;
  }
  result.correlation_area = correlation_area(result.map.geometry(), errors);
  result.correlation = settings.stable != nullptr ? "on stable ground" : "where change is not significant";
  if (std::isfinite(result.correlation_area)) return;
  result.correlation_area = 1;
  result.correlation = "too few quiet cells: errors of cells taken as independent";
}

/// What follows from the differences of the cells alone.
void compare_cells(const GridGeometry& grid, const HeightMap::Layer& first, const HeightMap::Layer& second,
                   const HeightMap& a, const HeightMap& b, const ComparisonSettings& settings,
                   SurfaceComparison& result) {
  result.map = HeightMap(grid);
  result.map.add(layer::difference, difference(first, second));
  result.difference = difference_figures(grid, result.map.layer(layer::difference));
  result.detection = add_levels(result.map, a, b, settings);
  find_correlation(settings, result);
  result.volume = volume_change(result.map, result.correlation_area, settings.common_sigma);
  result.significant_share =
      static_cast<double>(result.volume.significant_cells) / static_cast<double>(result.volume.known_cells);
}

}  // namespace

SurfaceComparison compare_surfaces(const HeightMap& a, const HeightMap& b, const HeightMap* start,
                                   const ComparisonSettings& settings) {
  const GridGeometry& grid = b.geometry();
  require_usable(settings);
  require_usable(a, grid, "the first surface");
  require_usable(b, grid, "the second surface");
  if (start != nullptr) require_usable(*start, grid, "the start");
  if (settings.stable != nullptr && settings.stable->size() != grid.size())
    throw Error("comparison: the mask of stable ground is on another grid");

  Surface first{a.layer(layer::elevation), {}, {}, {}, {}, 0};
  Surface second{b.layer(layer::elevation), {}, {}, {}, {}, 0};
  Surface origin;
  if (start != nullptr) origin.elevation = start->layer(layer::elevation);
  std::size_t common = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const float sum =
        first.elevation[i] + second.elevation[i] + (start != nullptr ? origin.elevation[i] : 0.0F);
    if (std::isfinite(sum)) {
      ++common;
      continue;
    }
    first.elevation[i] = second.elevation[i] = HeightMap::unknown;
    if (start != nullptr) origin.elevation[i] = HeightMap::unknown;
  }
  constexpr std::size_t fewest = 16;
  if (common < fewest)
    throw Error("comparison: " + std::to_string(common) + " cells are known in " +
                (start != nullptr ? "all" : "both") + " surfaces, at least " + std::to_string(fewest) +
                " are needed");

  SurfaceComparison result;
  std::vector<Surface*> surfaces{&first, &second};
  if (start != nullptr) surfaces.push_back(&origin);
  tbb::parallel_invoke(
      [&] { compare_cells(grid, first.elevation, second.elevation, a, b, settings, result); },
      [&] {
        fit_planes(grid, surfaces);
        tbb::parallel_for_each(surfaces,
                               [&](Surface* surface) { measure(grid, settings.direction, *surface); });
      });
  const double cell = grid.cell();
  const double wavelength = common_wavelength(first, second, cell);
  const int length = second.lines->length;
  const double longest_lag =
      std::isfinite(wavelength) ? std::min(3 * wavelength, 0.5 * length) : 0.5 * length;
  const auto lags = static_cast<std::size_t>(std::min(longest_lag, 600.0));
  const double alike = 0.25 * (first.rms + second.rms);  // half the roughness, as for profiles
  int segment = 16;
  while (segment < (std::isfinite(wavelength) ? 6 * wavelength : length / 8)) segment *= 2;
  while (segment > 8 && segment > length) segment /= 2;
  tbb::parallel_invoke(
      [&] { first.figures.scales = line_scales(*first.lines, cell, lags, alike); },
      [&] { second.figures.scales = line_scales(*second.lines, cell, lags, alike); },
      [&] { result.offset = displacement(second, first, wavelength, cell); },
      [&] {
        result.crests = crest_displacement(*second.lines, *first.lines, cell, wavelength * cell);
        if (equal(first.elevation, second.elevation)) clear_known(result.crests);
        result.map.add(layer::displacement, displacement_layer(result.crests, grid, settings.direction));
      },
      [&] { result.coherence = coherence(*first.lines, *second.lines, cell, segment); });
  if (start != nullptr) result.skill = forecast_skill(grid, first, second, origin, settings.direction);
  result.a = std::move(first.figures);
  result.b = std::move(second.figures);
  return result;
}

}  // namespace aeolian
