#include "aeolian_core/bedforms/erosion/half_excess_slides.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "aeolian_core/bedforms/wrapped.hpp"

namespace aeolian {
namespace {

struct Offset {
  int x, y;
};
constexpr std::array<Offset, 8> around{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

/// The neighbour's cell, or none beyond a wall.
bool neighbour(const ErodibleBed& bed, CellIndex c, Offset o, CellIndex& n) {
  const GridGeometry& g = bed.geometry();
  n = {c.x + o.x, c.y + o.y};
  if (bed.periodic()) n = {wrapped(n.x, g.nx()), wrapped(n.y, g.ny())};
  return g.contains(n);
}

}  // namespace

const std::vector<SlideSweep::Move>& SlideSweep::find(ErodibleBed& bed, double tan_repose) {
  const GridGeometry& g = bed.geometry();
  donors_.clear();
  moves_.clear();
  givers_.resize(g.size(), 0);
  const auto straight = static_cast<float>(tan_repose * g.cell());
  const auto unit = static_cast<float>(bed.unit());
  std::vector<std::uint8_t>& dirty = bed.dirty();

  // What changed may have become steep, or have made a neighbour so.
  const auto look_at = [&](int x, int y) {
    const std::size_t cell = g.index(x, y);
    const float height = bed.height(x, y);
    float most = unit;
    std::uint8_t receivers = 0;
    CellIndex n;
    for (std::size_t k = 0; k < around.size(); ++k) {
      if (!neighbour(bed, {x, y}, around[k], n) || bed.hole(g.index(n))) continue;
      const float rest = k < 4 ? straight : 1.41421356F * straight;
      const float excess = height - bed.height(n.x, n.y) - rest;
      if (excess > most) {
        most = excess;
        receivers = 0;
      }
      if (excess >= most) receivers = static_cast<std::uint8_t>(receivers | (1U << k));
    }
    if (receivers) donors_.push_back({cell, most, receivers});
  };
  TileMask& tiles = bed.dirty_tiles();
  TileMask near = tiles;
  near.dilate();
  if (bed.periodic())
    for (int ty = 0; ty < tiles.tiles_y(); ++ty)
      for (int tx = 0; tx < tiles.tiles_x(); ++tx)
        if (tiles.tile(tx, ty))
          for (const Offset o : around)
            near.set_tile(wrapped(tx + o.x, tiles.tiles_x()), wrapped(ty + o.y, tiles.tiles_y()));
  const int nx = g.nx();
  const int ny = g.ny();
  const auto is_near_dirty = [&](int x, int y) {
    if (dirty[g.index(x, y)]) return true;
    if (x > 0 && y > 0 && x < nx - 1 && y < ny - 1) {
      const std::uint8_t* at = &dirty[g.index(x, y)];
      const std::uint8_t* south = at - nx;
      const std::uint8_t* north = at + nx;
      return (at[-1] | at[1] | south[-1] | south[0] | south[1] | north[-1] | north[0] | north[1]) != 0;
    }
    CellIndex n;
    for (const Offset o : around)
      if (neighbour(bed, {x, y}, o, n) && dirty[g.index(n)]) return true;
    return false;
  };
  near.for_each([&](const CellRange& r) {
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        if (bed.loose(g.index(x, y)) > 0 && is_near_dirty(x, y)) look_at(x, y);
  });
  tiles.for_each([&](const CellRange& r) {
    for (int y = r.y0; y < r.y1; ++y)
      std::fill_n(dirty.begin() + static_cast<std::ptrdiff_t>(g.index(r.x0, y)), r.x1 - r.x0,
                  std::uint8_t{0});
  });
  tiles.clear();

  const auto for_each_receiver = [&](const Donor& donor, auto&& visit) {
    const CellIndex c = g.cell_at(donor.cell);
    CellIndex n;
    for (std::size_t k = 0; k < around.size(); ++k)
      if ((donor.receivers >> k & 1U) != 0 && neighbour(bed, c, around[k], n)) visit(g.index(n));
  };
  for (const Donor& donor : donors_) for_each_receiver(donor, [&](std::size_t cell) { ++givers_[cell]; });
  for (const Donor& donor : donors_) {
    const int shares = __builtin_popcount(donor.receivers);
    for_each_receiver(donor, [&](std::size_t cell) {
      // What n givers bring each is x / (n + 1): the half of the excess when there is one.
      const float due = donor.excess / static_cast<float>(givers_[cell] + shares) / unit;
      const std::int32_t share = bed.loose(donor.cell) / shares;
      const auto units = static_cast<std::int32_t>(std::min(due, static_cast<float>(share)));
      if (units > 0) moves_.push_back({donor.cell, cell, units});
    });
  }
  for (const Donor& donor : donors_) for_each_receiver(donor, [&](std::size_t cell) { givers_[cell] = 0; });
  return moves_;
}

}  // namespace aeolian
