#include "aeolian_core/bedforms/ripple_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "aeolian_core/bedforms/avalanche.hpp"
#include "aeolian_core/bedforms/hard_ground.hpp"
#include "aeolian_core/bedforms/impact_sweep.hpp"
#include "aeolian_core/bedforms/lateral_spread.hpp"
#include "aeolian_core/bedforms/lay_down.hpp"
#include "aeolian_core/bedforms/relief.hpp"
#include "aeolian_core/bedforms/sand_reach.hpp"
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
  active.for_all([&](int station, int patch, int begin, int end) {
    bool any = false;
    for (int row = begin; row < end; ++row)
      any = any || (bed.at(station)[row] - ground.floor.at(station)[row]) * ground.open.at(station)[row] >
                       least_movable;
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

}  // namespace

RippleModel::RippleModel(const RippleParameters& parameters) : parameters_(parameters) {
  require(parameters.slope_effect >= 0 && std::isfinite(parameters.slope_effect), "slope_effect",
          parameters.slope_effect, "zero or more and finite");
  require(parameters.hop_shortening >= 0 && std::isfinite(parameters.hop_shortening), "hop_shortening",
          parameters.hop_shortening, "zero or more and finite");
  require(parameters.lateral_spread >= 0 && std::isfinite(parameters.lateral_spread), "lateral_spread",
          parameters.lateral_spread, "zero or more and finite");
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

/// What a run works on: the whole grid, or on hard ground the part that sand may reach.
struct RippleModel::Run {
  const Forcing& forcing;
  const std::vector<double>* floor;
  const std::vector<double>* open;
  bool holes;
  const std::vector<double>& dune;
  const SandReach& reach;
  double cell;
  double dt;
};

BedChange RippleModel::advance(const GridGeometry& geometry, std::vector<double>& height,
                               const std::vector<double>* floor, const std::vector<double>* open,
                               const Forcing& forcing, double duration) const {
  const double erosion_rate = forcing.erosion_rate();
  const double hop = forcing.reptation_length;
  if (erosion_rate * hop * duration == 0) return {TileMask(geometry), {}};

  const bool periodic = parameters_.border == Border::periodic;
  const ImpactAngles angles(forcing.impact_angle, forcing.impact_angle_spread);
  const WindFrame whole(geometry, forcing.direction, periodic);
  const std::vector<double> dune = dune_surface(geometry, height, parameters_.relief_scale, periodic);
  const int aside = LateralSpread(whole, parameters_.lateral_spread * hop / geometry.cell()).reach_across();
  const SandReach reach(geometry, forcing.direction, hop, aside, angles.least_tangent());
  const bool holes = open && std::find(open->begin(), open->end(), 0.0) != open->end();
  const double steps = std::max(
      1.0,
      std::ceil(duration * erosion_rate / (parameters_.step * whole.step() * angles.effective_tangent())));
  const Run run{forcing, floor, open, holes, dune, reach, geometry.cell(), duration / steps};

  const std::vector<double> start = height;
  VolumeBalance volume;
  for (double step = 0; step < steps;) {
    std::optional<CellRange> part = CellRange{0, geometry.nx(), 0, geometry.ny()};
    if (floor && !holes && !periodic) part = reach.range(height, *floor, dune);
    if (!part) break;
    step += advance(run, whole.part(*part), steps - step, height, volume);
  }
  for (std::size_t i = 0; i < height.size(); ++i)
    volume.change += (height[i] - start[i]) * geometry.cell() * geometry.cell();
  return {changed_tiles(geometry, start, height), volume};
}

double RippleModel::advance(const Run& run, const WindFrame& frame, double steps, std::vector<double>& height,
                            VolumeBalance& volume) const {
  const double hop = run.forcing.reptation_length;
  const double cell = run.cell;
  const double tan_repose = std::tan(run.forcing.grain.angle_of_repose);
  const double slope_scale = parameters_.slope_effect * hop * run.forcing.erosion_rate();
  const ImpactAngles angles(run.forcing.impact_angle, run.forcing.impact_angle_spread);
  ImpactSweep impacts(frame, angles, hop, parameters_.hop_shortening);
  SlopeFlux slopes(frame, cell, slope_scale);
  Avalanches avalanches(frame.stations(), frame.rows(), cell, tan_repose, frame.periodic());
  const LateralSpread spread(frame, parameters_.lateral_spread * hop / cell);

  FrameField dune, bed;
  FrameField activity(frame.stations(), frame.rows());
  frame.enter(run.dune, dune);
  frame.enter(height, bed);
  HardGround ground;
  if (run.floor) {
    frame.enter(*run.floor, ground.floor);
    frame.enter(*run.open, ground.open);
    ground.holes = run.holes;
  }
  ActivePatches active(frame.stations(), frame.rows());
  ActivePatches sandy = active;

  const double dt = run.dt;
  const double depth = run.forcing.erosion_rate() * dt;
  const double area = cell * cell;
  double step = 0;
  for (; step < steps; ++step) {
    if (ground.any()) {
      find_sand(bed, ground, active, sandy);
      if (step > 0 && !run.reach.stays_within(frame, sandy)) break;
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
    if (ground.any()) {
      slopes.run(activity, laid.strongest, dt, ground, active, bed);
      volume.moved += avalanches.run(bed, ground, active);
    } else {
      slopes.run(activity, laid.strongest, dt, bed);
      volume.moved += avalanches.run(bed);
    }
  }
  frame.leave(bed, height);
  return step;
}

}  // namespace aeolian
