#include "aeolian_core/bedforms/lattice/haff_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/bedforms/theory/independent_members.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

HaffModel::HaffModel(const HaffModelParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), seed_(seed) {
  if (!(parameters.bin_length > 0 && std::isfinite(parameters.bin_length)))
    throw Error("Haff model: bin length is " + std::to_string(parameters.bin_length) +
                " d, must be positive");
  if (parameters.steepest_stoss && !(*parameters.steepest_stoss > 0 && *parameters.steepest_stoss < M_PI / 2))
    throw Error("Haff model: steepest stoss is " + std::to_string(*parameters.steepest_stoss) +
                " rad, must be between 0 and pi / 2");
}

std::size_t HaffModel::Slices::cell(const GridGeometry& geometry, int row, int along) const {
  const int at = quarter < 2 ? along : cells - 1 - along;
  return quarter % 2 == 0 ? geometry.index(at, row) : geometry.index(row, at);
}

bool HaffModel::Slices::operator==(const Slices& other) const {
  return quarter == other.quarter && rows == other.rows && cells == other.cells &&
         bins_per_cell == other.bins_per_cell && bin == other.bin && layer == other.layer;
}

HaffModel::Slices HaffModel::cut(const GridGeometry& geometry, const Forcing& forcing) const {
  const double turns = forcing.direction / (M_PI / 2);
  if (std::abs(turns - std::round(turns)) > 1e-6)
    throw Error("Haff model: the wind blows to " + std::to_string(forcing.direction * 180 / M_PI) +
                " degrees, must be along an axis of the grid: 0, 90, 180 or 270");
  const double d = forcing.grain.effective_diameter();
  Slices slices{};
  slices.quarter = static_cast<int>(std::fmod(std::fmod(std::round(turns), 4) + 4, 4));
  const bool along_x = slices.quarter % 2 == 0;
  slices.cells = along_x ? geometry.nx() : geometry.ny();
  slices.rows = along_x ? geometry.ny() : geometry.nx();
  const double bins_per_cell = std::max(1.0, std::round(geometry.cell() / (parameters_.bin_length * d)));
  if (bins_per_cell * slices.cells > 1e7)
    throw Error("Haff model: a row has " + std::to_string(bins_per_cell * slices.cells) +
                " bins, must be at most 10 million");
  slices.bins_per_cell = static_cast<int>(bins_per_cell);
  slices.bin = geometry.cell() / slices.bins_per_cell;
  slices.layer = d * d / slices.bin;
  return slices;
}

/// As many grains in each bin as bring it to the surface, linear between the centres of cells; what a whole
/// number of grains is off is made up for in the next bin of the row.
std::vector<std::vector<int>> HaffModel::fill(const GridGeometry& geometry) const {
  constexpr double highest = 1e5;
  const std::vector<double>& height = surface_.height();
  std::vector<std::vector<int>> grains(static_cast<std::size_t>(slices_.rows));
  for (int row = 0; row < slices_.rows; ++row) {
    const auto height_at = [&](int along) {
      return height[slices_.cell(geometry, row, (along + slices_.cells) % slices_.cells)];
    };
    double owed = 0;
    for (int bin = 0; bin < slices_.bins(); ++bin) {
      const double centre = (bin + 0.5) / slices_.bins_per_cell - 0.5;
      const int cell = static_cast<int>(std::floor(centre));
      const double part = centre - cell;
      const double surface = height_at(cell) * (1 - part) + height_at(cell + 1) * part - height_at(0);
      if (!(std::abs(surface) < highest * slices_.layer))
        throw Error("Haff model: the relief along a row is " + std::to_string(surface) +
                    " m, must be below " + std::to_string(highest * slices_.layer) + " m");
      owed += surface / slices_.layer;
      const auto whole = static_cast<int>(std::lround(owed));
      grains[static_cast<std::size_t>(row)].push_back(whole);
      owed -= whole;
    }
  }
  return grains;
}

/// The bed of each row; none if hops are so many times around the bed that all come down where they came
/// from.
std::optional<HaffParameters> HaffModel::bed_of(const Slices& slices, const Forcing& forcing) const {
  const double hop = std::round(forcing.reptation_length / slices.bin);
  if (!(hop >= 1))
    throw Error("Haff model: reptation length is " + std::to_string(forcing.reptation_length) +
                " m, must be at least half a bin, " + std::to_string(slices.bin / 2) + " m");
  HaffParameters bed;
  bed.bins = slices.bins();
  bed.bin_length = slices.bin / forcing.grain.effective_diameter();
  bed.reptation_length = std::fmod(hop, slices.bins()) * bed.bin_length;
  bed.impact_angle = forcing.impact_angle;
  bed.angle_of_repose = forcing.grain.angle_of_repose;
  bed.steepest_stoss = parameters_.steepest_stoss;
  return bed.reptation_length > 0 ? std::optional(bed) : std::nullopt;
}

BedChange HaffModel::advance(HeightMap& map, const Forcing& forcing, double duration) {
  check(forcing, duration);
  check_all_sand("Haff model", map);
  const GridGeometry& geometry = map.geometry();
  const Slices slices = cut(geometry, forcing);
  if (forcing.erosion_rate() * duration == 0) return {TileMask(geometry), {}};
  const std::optional<HaffParameters> bed = bed_of(slices, forcing);
  if (!bed) return {TileMask(geometry), {}};

  if (surface_.take(map) || !(slices == slices_)) grains_.clear();
  slices_ = slices;
  if (grains_.empty()) grains_ = fill(geometry);

  const double d = forcing.grain.effective_diameter();
  const double impacts = forcing.ejection_rate * duration * d * d;  // per d of a slice
  struct Blown {
    std::vector<int> grains;
    std::int64_t moved;
  };
  const std::vector<Blown> beds = run_members(slices.rows, [&](int row) {
    const std::uint64_t stream = streams_ + 2 * static_cast<std::uint64_t>(row);
    HaffBed slice(*bed, grains_[static_cast<std::size_t>(row)], seed_, stream);
    // A part of an impact falls with that probability.
    slice.advance(impacts + RandomStream(seed_, stream + 1).uniform() / slice.length());
    return Blown{slice.grains(), slice.moved()};
  });
  streams_ += 2 * static_cast<std::uint64_t>(slices.rows);

  std::vector<double> change(geometry.size());
  double moved = 0;
  for (int row = 0; row < slices.rows; ++row) {
    std::vector<int>& before = grains_[static_cast<std::size_t>(row)];
    const Blown& after = beds[static_cast<std::size_t>(row)];
    for (int bin = 0; bin < slices.bins(); ++bin) {
      const auto i = static_cast<std::size_t>(bin);
      change[slices.cell(geometry, row, bin / slices.bins_per_cell)] +=
          (after.grains[i] - before[i]) * slices.layer / slices.bins_per_cell;
    }
    moved += static_cast<double>(after.moved) * slices.layer * slices.bin * geometry.cell();
    before = after.grains;
  }
  return surface_.store(change, moved, map);
}

}  // namespace aeolian
