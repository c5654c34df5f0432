#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// What lies where no ground is known, or where it is deeper than that: 80 m of parcels of 0.15 mm.
constexpr double deepest = 1 << 29;

std::size_t tile_of(const TileMask& tiles, int ix, int iy) {
  return static_cast<std::size_t>(iy / TileMask::tile_cells) * static_cast<std::size_t>(tiles.tiles_x()) +
         static_cast<std::size_t>(ix / TileMask::tile_cells);
}

float last_place(int n, bool periodic) {
  const auto count = static_cast<float>(n);
  return periodic ? std::nextafter(count, 0.0F) : count - 1;
}

}  // namespace

ErodibleBed::ErodibleBed(const HeightMap& map, double parcel, bool periodic)
    : geometry_(map.geometry()),
      periodic_(periodic),
      parcel_(parcel),
      unit_(parcel / parcel_units),
      blocks_x_((geometry_.nx() + block_cells - 1) / block_cells),
      blocks_y_((geometry_.ny() + block_cells - 1) / block_cells),
      last_x_(last_place(geometry_.nx(), periodic)),
      last_y_(last_place(geometry_.ny(), periodic)),
      base_(geometry_.size()),
      loose_(geometry_.size(), 0),
      sintered_(geometry_.size(), 0),
      hole_(geometry_.size(), 0),
      surface_(static_cast<std::size_t>(geometry_.nx() + 1) * static_cast<std::size_t>(geometry_.ny() + 1)),
      dirty_(geometry_.size(), 1),
      dirty_tiles_(geometry_, true),
      changed_(geometry_) {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (count_known(elevation) == 0) throw Error("erosion: the layer elevation has no known cell");
  const HeightMap::Layer everywhere = filled(geometry_, elevation);
  const HeightMap::Layer* ground = map.has(layer::ground) ? &map.layer(layer::ground) : nullptr;
  const HeightMap::Layer* sintered = map.has("sintered") ? &map.layer("sintered") : nullptr;
  datum_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const double top = everywhere[i];
    hole_[i] = std::isfinite(elevation[i]) ? 0 : 1;
    double units = 0;
    if (!hole_[i]) {
      const bool floor = ground && std::isfinite((*ground)[i]);
      units = floor ? std::floor((top - static_cast<double>((*ground)[i])) / unit_) : deepest;
      units = std::clamp(units, 0.0, deepest);
    }
    if (sintered && std::isfinite((*sintered)[i]))
      sintered_[i] = static_cast<std::int32_t>(
          std::clamp(std::round(static_cast<double>((*sintered)[i]) / unit_), 0.0, units));
    loose_[i] = static_cast<std::int32_t>(units) - sintered_[i];
    base_[i] = top - unit_ * units;
    datum_ = std::min(datum_, top);
  }
  covered_in_tile_.assign(
      static_cast<std::size_t>(changed_.tiles_x()) * static_cast<std::size_t>(changed_.tiles_y()), 0);
  highest_of_block_.assign(static_cast<std::size_t>(blocks_x_) * static_cast<std::size_t>(blocks_y_),
                           -std::numeric_limits<float>::infinity());
  highest_ = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const CellIndex c = geometry_.cell_at(i);
    show(c, i);
    covered_in_tile_[tile_of(changed_, c.x, c.y)] += covered(i) ? 1 : 0;
  }
}

void ErodibleBed::show(CellIndex c, std::size_t cell) {
  const auto value = static_cast<float>(elevation(cell) - datum_);
  highest_ = std::max(highest_, value);
  raise_blocks(c, value);
  const auto row = static_cast<std::size_t>(stride());
  float* at = &surface_[static_cast<std::size_t>(c.y) * row + static_cast<std::size_t>(c.x)];
  *at = value;
  const int nx = geometry_.nx();
  const int ny = geometry_.ny();
  const bool pad_x = periodic_ ? c.x == 0 : c.x == nx - 1;
  const bool pad_y = periodic_ ? c.y == 0 : c.y == ny - 1;
  const auto across = static_cast<std::size_t>(periodic_ ? nx : 1);
  const auto up = row * static_cast<std::size_t>(periodic_ ? ny : 1);
  if (pad_x) at[across] = value;
  if (pad_y) at[up] = value;
  if (pad_x && pad_y) at[up + across] = value;
}

/// The block of a cell, and those before it, whose last places lie between their own cells and this one.
void ErodibleBed::raise_blocks(CellIndex c, float height) {
  const int bx = c.x / block_cells;
  const int by = c.y / block_cells;
  const auto raise = [&](int x, int y) {
    const auto row = static_cast<std::size_t>((y + blocks_y_) % blocks_y_);
    const auto column = static_cast<std::size_t>((x + blocks_x_) % blocks_x_);
    float& highest = highest_of_block_[row * static_cast<std::size_t>(blocks_x_) + column];
    highest = std::max(highest, height);
  };
  if (height > highest_of_block(bx, by)) raise(bx, by);
  const bool first_x = c.x % block_cells == 0;
  const bool first_y = c.y % block_cells == 0;
  if (first_x) raise(bx - 1, by);
  if (first_y) raise(bx, by - 1);
  if (first_x && first_y) raise(bx - 1, by - 1);
}

void ErodibleBed::change(CellIndex c, std::size_t cell, std::int32_t loose, std::int32_t sintered) {
  const bool before = covered(cell);
  loose_[cell] += loose;
  sintered_[cell] += sintered;
  if (before != covered(cell)) covered_in_tile_[tile_of(changed_, c.x, c.y)] += before ? -1 : 1;
  if (loose + sintered == 0) return;
  dirty_[cell] = 1;
  dirty_tiles_.activate(c.x, c.y);
  changed_.activate(c.x, c.y);
  show(c, cell);
}

void ErodibleBed::turn_to_ground() {
  for (std::size_t i = 0; i < base_.size(); ++i) {
    base_[i] = elevation(i);
    ground_units_ += std::int64_t{loose_[i]} + sintered_[i];
    loose_[i] = sintered_[i] = 0;
  }
  std::fill(covered_in_tile_.begin(), covered_in_tile_.end(), 0);
}

std::int64_t ErodibleBed::total_units() const {
  std::int64_t total = ground_units_;
  for (std::size_t i = 0; i < loose_.size(); ++i) total += std::int64_t{loose_[i]} + sintered_[i];
  return total;
}

TileMask ErodibleBed::take_changed() {
  TileMask result = changed_;
  changed_.clear();
  return result;
}

}  // namespace aeolian
