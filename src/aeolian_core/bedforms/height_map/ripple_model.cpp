#include "aeolian_core/bedforms/height_map/ripple_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "aeolian_core/bedforms/height_map/relief.hpp"
#include "aeolian_core/bedforms/height_map/ripple_motion.hpp"
#include "aeolian_core/bedforms/height_map/sand_reach.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"ripple model"};

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

/// What moves on a flat bed, and crosses its borders if they are open.
VolumeBalance flat_balance(const GridGeometry& g, const Forcing& forcing, double duration, bool open) {
  const double depth = forcing.erosion_rate() * duration;
  VolumeBalance volume;
  volume.moved = depth * g.length_x() * g.length_y();
  if (open)
    volume.inflow = volume.outflow = depth * forcing.reptation_length *
                                     (std::abs(std::cos(forcing.direction)) * g.length_y() +
                                      std::abs(std::sin(forcing.direction)) * g.length_x());
  return volume;
}

constexpr int steps_per_estimate = 16;      ///< of their error, which costs one step
constexpr double shortest_step = 1.0 / 64;  ///< of the longest

}  // namespace

RippleModel::RippleModel(const RippleParameters& parameters) : parameters_(parameters) {
  require(parameters.supply >= 0 && std::isfinite(parameters.supply), "supply", parameters.supply,
          "zero or more and finite");
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
  require(parameters.error_bound >= 0 && std::isfinite(parameters.error_bound), "error_bound",
          parameters.error_bound, "zero or more and finite");
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
    BedChange change = advance(map.geometry(), height, forcing, duration);
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
  BedChange change = advance(map.geometry(), height, &floor, &open, forcing, duration);
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
  if (stays_flat(height)) {
    // A law refuses what it cannot tell of.
    if (parameters_.wavelength_law) parameters_.wavelength_law->final_wavelength(forcing);
    clock_.time += duration;
    return {TileMask(geometry),
            flat_balance(geometry, forcing, duration, parameters_.border == Border::open)};
  }
  return advance(geometry, height, nullptr, nullptr, forcing, duration);
}

/// Whether nothing changes, since as much comes down everywhere as is struck: on flat sand that flat sand
/// supplies.
bool RippleModel::stays_flat(const std::vector<double>& height) const {
  return (parameters_.border == Border::periodic || parameters_.inflow == Inflow::flat_bed) &&
         parameters_.stochastic_share == 0 &&
         std::all_of(height.begin(), height.end(), [&](double h) { return h == height.front(); });
}

/// Makes steps for so long [s], or until sand may leave the part of the grid in motion. Returns the time
/// left.
double RippleModel::run(RippleMotion& motion, const SandReach& reach, double left) {
  const double longest = motion.longest_step();
  double wanted = longest;
  for (int step = 0; left > 0; ++step) {
    if (step > 0 && motion.may_leave(reach)) break;
    const double steps = std::max(1.0, std::ceil(left / wanted * (1 - 1e-12)));
    const double dt = left / steps;
    if (parameters_.error_bound > 0 && step % steps_per_estimate == 0) {
      const double error_rate = motion.step_and_compare(dt, clock_) / dt;
      const double within = dt * parameters_.error_bound / error_rate;
      wanted = std::clamp(within, shortest_step * longest, longest);
    } else {
      motion.step(dt, clock_);
    }
    left = steps > 1 ? left - dt : 0;
  }
  motion.finish();
  return left;
}

BedChange RippleModel::advance(const GridGeometry& geometry, std::vector<double>& height,
                               const std::vector<double>* floor, const std::vector<double>* open,
                               const Forcing& forcing, double duration) {
  if (forcing.erosion_rate() * forcing.reptation_length * duration == 0) return {TileMask(geometry), {}};
  const bool periodic = parameters_.border == Border::periodic;
  const WindFrame whole(geometry, forcing.direction, periodic);
  const std::vector<double> dune = dune_surface(geometry, height, parameters_.relief_scale, periodic);
  const bool holes = open && std::find(open->begin(), open->end(), 0.0) != open->end();
  const RippleSetting setting{parameters_, forcing, geometry.cell(), dune, floor, open, holes};
  const SandReach reach(geometry, forcing.direction, forcing.reptation_length,
                        reach_aside(parameters_, forcing, whole, geometry.cell()),
                        ImpactAngles(forcing.impact_angle, forcing.impact_angle_spread).least_tangent());
  // What a part does not see of the whole must not matter to it.
  const bool in_parts = floor && !holes && !periodic && parameters_.stochastic_share == 0 &&
                        parameters_.inflow != Inflow::ripples;

  const std::vector<double> start = height;
  VolumeBalance volume;
  for (double left = duration; left > 0;) {
    std::optional<CellRange> part = CellRange{0, geometry.nx(), 0, geometry.ny()};
    if (in_parts) part = reach.range(height, *floor, dune);
    if (!part) {
      clock_.time += left;
      break;
    }
    RippleMotion motion(setting, whole.part(*part), height);
    left = run(motion, reach, left);
    motion.leave(height);
    volume.moved += motion.volume().moved;
    volume.inflow += motion.volume().inflow;
    volume.outflow += motion.volume().outflow;
  }
  for (std::size_t i = 0; i < height.size(); ++i)
    volume.change += (height[i] - start[i]) * geometry.cell() * geometry.cell();
  return {changed_tiles(geometry, start, height), volume};
}

}  // namespace aeolian
