#include "aeolian_core/bedforms/ripple_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "aeolian_core/bedforms/avalanche.hpp"
#include "aeolian_core/bedforms/hard_ground.hpp"
#include "aeolian_core/bedforms/impact_noise.hpp"
#include "aeolian_core/bedforms/impact_sweep.hpp"
#include "aeolian_core/bedforms/lateral_spread.hpp"
#include "aeolian_core/bedforms/lay_down.hpp"
#include "aeolian_core/bedforms/long_wave_flux.hpp"
#include "aeolian_core/bedforms/relief.hpp"
#include "aeolian_core/bedforms/ripple_growth.hpp"
#include "aeolian_core/bedforms/slope_bias.hpp"
#include "aeolian_core/bedforms/slope_flux.hpp"
#include "aeolian_core/bedforms/wind_frame.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

void require(bool allowed, const char* name, double value, const char* range) {
  if (!allowed)
    throw Error("ripple model: " + std::string(name) + " is " + std::to_string(value) + ", must be " + range);
}

/// Says anew of the active patches whether sand lies there that can move.
void find_sand(const FrameField& bed, const HardGround& ground, const ActivePatches& active,
               ActivePatches& sandy) {
  constexpr double least = 1e-6;  // [m], far less than a grain
  active.for_all([&](int station, int patch, int begin, int end) {
    bool any = false;
    for (int row = begin; row < end; ++row)
      any = any ||
            (bed.at(station)[row] - ground.floor.at(station)[row]) * ground.open.at(station)[row] > least;
    sandy.set(station, patch, any);
  });
}

void clear(const ActivePatches& active, const WindFrame& frame, FrameField& field) {
  for (int station = 0; station < frame.stations(); ++station) {
    bool any = false;
    active.for_runs(station, [&](int begin, int end) {
      std::fill(field.at(station) + begin, field.at(station) + end, 0.0);
      any = true;
    });
    if (any) field.fill_pads(station, frame.periodic());
  }
}

TileMask changed_tiles(const GridGeometry& g, const std::vector<double>& before,
                       const std::vector<double>& after) {
  TileMask result(g);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      if (before[g.index(x, y)] != after[g.index(x, y)]) result.activate(x, y);
  return result;
}

/// Writes heights into the known cells of a layer of floats. What rounding takes from a cell is given to the
/// next known one, so that the layer's sum is right to the rounding of one cell.
void store(const std::vector<double>& height, HeightMap::Layer& layer) {
  double carry = 0;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (!std::isfinite(layer[i])) continue;
    layer[i] = static_cast<float>(height[i] + carry);
    carry += height[i] - static_cast<double>(layer[i]);
  }
}

constexpr double steps_per_saturation = 16;  ///< long waves change that slowly

/// The shortest wavelength of a long-wave flux, in those that grow fastest: their growth changes by less than
/// 0.5 %.
constexpr double shortest_limit = 1.6;

/// The flux that keeps ripples from growing beyond the law's wavelength. In runs of several winds and grains
/// they settled at 0.865 times its own wavelength where that was the shortest, and by its cube root less
/// where it was longer (docs/ripple_model.md).
std::optional<LongWaveFlux> saturating_flux(const RippleParameters& parameters, const WindFrame& frame,
                                            double cell, const Forcing& forcing) {
  if (!parameters.wavelength_law) return std::nullopt;
  const FastestGrowth growth = fastest_growth(forcing, parameters.hop_shortening, parameters.slope_effect);
  if (!(growth.rate > 0)) return std::nullopt;
  const double shortest = shortest_limit * growth.wavelength;
  const double settled =
      std::max(1.0, parameters.wavelength_law->final_wavelength(forcing) / (0.865 * shortest));
  const double wavelength = shortest * std::pow(settled, 1.5);
  return LongWaveFlux(frame, cell, wavelength, growth.rate * std::pow(wavelength / (2 * M_PI), 2));
}

}  // namespace

RippleModel::RippleModel(const RippleParameters& parameters) : parameters_(parameters) {
  require(parameters.slope_effect >= 0 && std::isfinite(parameters.slope_effect), "slope_effect",
          parameters.slope_effect, "zero or more and finite");
  require(parameters.hop_shortening >= 0 && std::isfinite(parameters.hop_shortening), "hop_shortening",
          parameters.hop_shortening, "zero or more and finite");
  require(parameters.doubling_slope > 0 && parameters.doubling_slope <= M_PI / 2, "doubling_slope",
          parameters.doubling_slope, "above zero, at most a right angle");
  require(parameters.lateral_spread >= 0 && std::isfinite(parameters.lateral_spread), "lateral_spread",
          parameters.lateral_spread, "zero or more and finite");
  require(parameters.stochastic_share >= 0 && parameters.stochastic_share <= 1, "stochastic_share",
          parameters.stochastic_share, "0 to 1");
  require(parameters.step > 0 && parameters.step <= 1, "step", parameters.step, "above zero, at most one");
  require(parameters.relief_scale > 0, "relief_scale", parameters.relief_scale, "positive");
}

BedChange RippleModel::advance(HeightMap& map, const Forcing& forcing, double duration) {
  HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (parameters_.border == Border::periodic && count_known(elevation) != elevation.size())
    throw Error("ripple model: a periodic map must be known everywhere");
  check(forcing, duration);
  if (forcing.erosion_rate() * forcing.reptation_length * duration == 0)
    return {TileMask(map.geometry()), {}};
  const HeightMap::Layer whole = filled(map.geometry(), elevation);
  std::vector<double> height(whole.begin(), whole.end());
  if (count_known(elevation) == elevation.size() && !map.has(layer::ground)) {
    const BedChange change = advance(map.geometry(), height, forcing, duration);
    store(height, elevation);
    return change;
  }
  std::vector<double> floor(height.size(), HardGround::bottomless);
  std::vector<double> open(height.size());
  for (std::size_t i = 0; i < height.size(); ++i) {
    open[i] = std::isfinite(elevation[i]) ? 1 : 0;
    if (!map.has(layer::ground)) continue;
    const double ground = map.layer(layer::ground)[i];
    if (std::isfinite(ground)) floor[i] = std::min(ground, height[i]);
  }
  const BedChange change = advance(map.geometry(), height, &floor, &open, forcing, duration);
  store(height, elevation);
  return change;
}

BedChange RippleModel::advance(const GridGeometry& geometry, std::vector<double>& height,
                               const Forcing& forcing, double duration) {
  check(forcing, duration);
  if (height.size() != geometry.size())
    throw Error("ripple model: " + std::to_string(height.size()) + " heights for " +
                std::to_string(geometry.size()) + " cells");
  if (!std::all_of(height.begin(), height.end(), [](double h) { return std::isfinite(h); }))
    throw Error("ripple model: a height is not finite");
  return advance(geometry, height, nullptr, nullptr, forcing, duration);
}

BedChange RippleModel::advance(const GridGeometry& geometry, std::vector<double>& height,
                               const std::vector<double>* floor, const std::vector<double>* open,
                               const Forcing& forcing, double duration) {
  const double erosion_rate = forcing.erosion_rate();
  const double hop = forcing.reptation_length;
  if (erosion_rate * hop * duration == 0) return {TileMask(geometry), {}};

  const bool periodic = parameters_.border == Border::periodic;
  const double cell = geometry.cell();
  const double tan_impact = std::tan(forcing.impact_angle);
  const double tan_repose = std::tan(forcing.grain.angle_of_repose);
  const double slope_scale = parameters_.slope_effect * hop * erosion_rate;
  const WindFrame frame(geometry, forcing.direction, periodic);
  ImpactSweep impacts(frame, tan_impact, hop, parameters_.hop_shortening);
  SlopeFlux slopes(frame, cell, slope_scale);
  Avalanches avalanches(frame.stations(), frame.rows(), cell, tan_repose, periodic);
  const LateralSpread spread(frame, parameters_.lateral_spread * hop / cell);
  const double grain_volume = std::pow(forcing.grain.effective_diameter(), 3);
  std::optional<ImpactNoise> noise;
  if (parameters_.stochastic_share > 0)
    noise.emplace(frame, cell,
                  ImpactNoise::Hop{hop, parameters_.lateral_spread * hop, parameters_.hop_shortening},
                  grain_volume, parameters_.stochastic_share, parameters_.seed);
  std::optional<LongWaveFlux> saturation = saturating_flux(parameters_, frame, cell, forcing);

  const std::vector<double> start = height;
  FrameField dune, bed;
  FrameField activity(frame.stations(), frame.rows());
  frame.enter(dune_surface(geometry, height, parameters_.relief_scale, periodic), dune);
  frame.enter(height, bed);
  HardGround ground;
  if (floor) {
    frame.enter(*floor, ground.floor);
    frame.enter(*open, ground.open);
    ground.holes = std::find(open->begin(), open->end(), 0.0) != open->end();
  }
  ActivePatches active(frame.stations(), frame.rows());
  ActivePatches sandy = active;

  VolumeBalance volume;
  const double steps =
      std::max(1.0, std::ceil(duration * erosion_rate / (parameters_.step * frame.step() * tan_impact)));
  const double dt = duration / steps;
  const double depth = erosion_rate * dt;
  const double area = cell * cell;
  const FastestGrowth growth = fastest_growth(forcing, parameters_.hop_shortening, parameters_.slope_effect);
  const Inflow inflow =
      growth.rate > 0 || parameters_.inflow == Inflow::none ? parameters_.inflow : Inflow::flat_bed;
  double unsaturated = 0;  // time in which long waves have grown freely
  for (double step = 0; step < steps; ++step) {
    if (!periodic)
      impacts.set_supply(border_supply(inflow, growth.wavelength, 2 * M_PI * growth.speed / growth.wavelength,
                                       cell, time_, parameters_.seed));
    if (ground.any()) {
      find_sand(bed, ground, active, sandy);
      clear(active, frame, activity);
      impacts.run(bed, dune, ground, sandy, depth, active);
    } else {
      impacts.run(bed, dune, depth);
    }
    const LaidDown laid =
        lay_down(frame, impacts, spread, depth, ground.any() ? &ground.open : nullptr, active, bed, activity);
    volume.moved += laid.eroded * depth * area;
    volume.inflow += laid.inflow * depth * area;
    volume.outflow += laid.outflow * depth * area;
    const HardGround* const hard = ground.any() ? &ground : nullptr;
    if (noise) noise->run(impacts, depth, noisy_steps_++, hard, active, bed);
    const double strongest =
        parameters_.doubling_slope < M_PI / 2
            ? stiffen(frame, cell, std::tan(parameters_.doubling_slope), dune, bed, active, activity)
            : laid.strongest;
    if (ground.any()) {
      slopes.run(activity, strongest, dt, ground, active, bed);
      volume.moved += avalanches.run(bed, ground, active);
    } else {
      slopes.run(activity, strongest, dt, bed);
      volume.moved += avalanches.run(bed);
    }
    unsaturated += dt;
    time_ += dt;
    if (saturation && (unsaturated >= steps_per_saturation * dt || step + 1 >= steps)) {
      saturation->run(dune, unsaturated, hard, active, bed);
      unsaturated = 0;
    }
  }
  frame.leave(bed, height);
  for (std::size_t i = 0; i < height.size(); ++i) volume.change += (height[i] - start[i]) * area;
  return {changed_tiles(geometry, start, height), volume};
}

}  // namespace aeolian
