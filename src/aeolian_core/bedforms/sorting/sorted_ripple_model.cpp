#include "aeolian_core/bedforms/sorting/sorted_ripple_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "aeolian_core/bedforms/height_map/relief.hpp"
#include "aeolian_core/bedforms/height_map/slope_bias.hpp"
#include "aeolian_core/bedforms/sorting/sorted_avalanche.hpp"
#include "aeolian_core/bedforms/sorting/sorted_lay_down.hpp"
#include "aeolian_core/bedforms/sorting/sorted_slope_flux.hpp"
#include "aeolian_core/bedforms/sorting/sub_grid_roughness.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"sorted ripple model"};

bool same_bits(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// What one size does, relative to fine grains.
struct Size {
  double mobility, hop;
};

Size size_of(const Forcing& forcing, const Forcing& fine) {
  const double mobility = forcing.erosion_rate() / fine.erosion_rate();
  if (mobility * forcing.reptation_length == 0) return {0, fine.reptation_length};  // it lies still
  return {mobility, forcing.reptation_length};
}

}  // namespace

BedLayers SortedRippleParameters::layers() const {
  return {active_layer * coarse_diameter, stratum * coarse_diameter, strata, coarse_fraction};
}

SortedRippleModel::SortedRippleModel(const SortedRippleParameters& parameters) : parameters_(parameters) {
  const RippleModel checks_the_rest(parameters.ripples);
  require(parameters.coarse_diameter > 0 && std::isfinite(parameters.coarse_diameter), "coarse_diameter",
          parameters.coarse_diameter, "positive and finite");
  require(parameters.active_layer >= 0.5 && std::isfinite(parameters.active_layer), "active_layer",
          parameters.active_layer, "half a coarse diameter or more and finite");
  require(parameters.stratum > 0 && std::isfinite(parameters.stratum), "stratum", parameters.stratum,
          "positive and finite");
  const auto refuse = [](bool asked, const char* what) {
    if (asked) throw Error("sorted ripple model: two sizes of grains know no " + std::string(what));
  };
  refuse(parameters.ripples.wavelength_law != nullptr, "wavelength law");
  refuse(parameters.ripples.stochastic_share > 0, "noise of single grains (stochastic_share)");
  refuse(parameters.ripples.inflow == Inflow::ripples, "inflow of ripples");
  check(parameters.layers());
}

bool SortedRippleModel::is_as_left(const HeightMap& map) const {
  return bed_ && map.has(layer::coarse_fraction) && map.geometry() == bed_->geometry &&
         same_bits(map.layer(layer::elevation), left_height_) &&
         same_bits(map.layer(layer::coarse_fraction), left_fraction_);
}

BedChange SortedRippleModel::advance(HeightMap& map, const Forcing& forcing, double duration) {
  HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (map.has(layer::ground) && count_known(map.layer(layer::ground)) > 0)
    throw Error("sorted ripple model: the map has hard ground, must be sand throughout");
  if (parameters_.ripples.border == Border::periodic && count_known(elevation) != elevation.size())
    throw Error("sorted ripple model: a periodic map must be known everywhere");
  const SortedForcing both = sorted_forcing(forcing, parameters_.coarse_diameter);
  check(both, duration);
  if (forcing.erosion_rate() * forcing.reptation_length * duration == 0)
    return {TileMask(map.geometry()), {}};

  if (!is_as_left(map)) bed_.emplace(map, parameters_.layers());
  SortedChange change = advance(*bed_, both, duration);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    if (std::isfinite(elevation[i])) elevation[i] = static_cast<float>(bed_->height[i]);
  bed_->write_composition(map);
  left_height_ = elevation;
  left_fraction_ = map.layer(layer::coarse_fraction);
  advance_roughness(map, both, duration, parameters_.ripples);

  VolumeBalance total = change.fine;
  total.moved += change.coarse.moved;
  total.change += change.coarse.change;
  total.inflow += change.coarse.inflow;
  total.outflow += change.coarse.outflow;
  return {std::move(change.active), total};
}

SortedChange SortedRippleModel::advance(SortedBed& bed, const SortedForcing& forcing, double duration) const {
  check(forcing, duration);
  const GridGeometry& geometry = bed.geometry;
  const Forcing& fine = forcing.fine;
  const double erosion_rate = fine.erosion_rate();
  if (erosion_rate * fine.reptation_length * duration == 0) return {TileMask(geometry), {}, {}};

  const RippleParameters& p = parameters_.ripples;
  const bool periodic = p.border == Border::periodic;
  const double cell = geometry.cell();
  const ImpactAngles angles(fine.impact_angle, fine.impact_angle_spread);
  const double tan_impact = angles.effective_tangent();
  const double tan_repose = std::tan(fine.grain.angle_of_repose);
  const Size coarse = size_of(forcing.coarse, fine);
  const double hop = fine.reptation_length;
  const WindFrame frame(geometry, fine.direction, periodic);
  SortedSweep sweep(frame,
                    {size_law(frame, angles, hop, p.hop_shortening, 1, false),
                     size_law(frame, angles, coarse.hop, p.hop_shortening, coarse.mobility, true)},
                    p.inflow == Inflow::none ? 0 : 1);
  const std::array<LateralSpread, 2> spread{LateralSpread(frame, p.lateral_spread * hop / cell),
                                            LateralSpread(frame, p.lateral_spread * coarse.hop / cell)};
  SortedSlopeFlux slopes(frame, cell, p.slope_effect * hop * erosion_rate);
  SortedAvalanches avalanches(frame, cell, tan_repose);
  const ActivePatches everywhere(frame.stations(), frame.rows());

  const std::vector<double> start = bed.height;
  const double coarse_before = bed.coarse_volume();
  FrameField dune, height;
  FrameField activity(frame.stations(), frame.rows());
  frame.enter(dune_surface(geometry, bed.height, p.relief_scale, periodic), dune);
  frame.enter(bed.height, height);
  ActiveLayer layer(frame, bed);
  avalanches.run(height, layer);
  layer.settle();

  SortedChange change{TileMask(geometry), {}, {}};
  const double thickness = bed.layers.active;
  // Slopes at repose are struck so much more than a flat bed. A step takes no more than the layer from them.
  const double steepest_exposure = 1 + 1.01 * tan_repose / tan_impact;
  const double longest = std::min(p.step * frame.step() * tan_impact, thickness / steepest_exposure);
  for (double left = duration * erosion_rate; left > 0;) {
    const double mobility = std::max(1.0, 1 + (coarse.mobility - 1) * layer.coarsest());
    const double steps = std::max(1.0, std::ceil(left * mobility / longest - 1e-9));
    const double depth = left / steps;
    left = steps > 1 ? left - depth : 0;

    sweep.run(height, dune, layer.fraction(), depth, thickness);
    const SortedLaidDown laid =
        lay_down(frame, sweep, spread, depth, coarse.hop / hop, height, layer, activity);
    const double strongest = p.doubling_slope < M_PI / 2 ? stiffen(frame, cell, std::tan(p.doubling_slope),
                                                                   dune, height, everywhere, activity)
                                                         : laid.strongest;
    slopes.run(activity, strongest, depth / erosion_rate, height, layer);
    avalanches.run(height, layer);
    layer.settle();

    const double per_cell = depth * cell * cell;
    for (VolumeBalance* volume : {&change.fine, &change.coarse}) {
      const std::size_t s = volume == &change.fine ? 0 : 1;
      volume->moved += laid.eroded[s] * per_cell;
      volume->inflow += laid.inflow[s] * per_cell;
      volume->outflow += laid.outflow[s] * per_cell;
    }
  }
  frame.leave(height, bed.height);
  layer.leave();
  change.coarse.change = bed.coarse_volume() - coarse_before;
  for (std::size_t i = 0; i < start.size(); ++i)
    change.fine.change += (bed.height[i] - start[i]) * cell * cell;
  change.fine.change -= change.coarse.change;
  change.active = changed_tiles(geometry, start, bed.height);
  return change;
}

}  // namespace aeolian
