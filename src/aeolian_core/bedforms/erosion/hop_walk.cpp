#include "aeolian_core/bedforms/erosion/hop_walk.hpp"

namespace aeolian {
namespace {

constexpr int most_steps = 20000;

/// Height over the beginning and vertical velocity along a hop, against the part of its range.
struct Arc {
  float apex, apex_part, up, down;

  float height(float part) const { return apex * (1 - square(part)); }
  float vertical(float part) const {
    return part < apex_part ? up * (apex_part - part) / apex_part
                            : -down * (part - apex_part) / (1 - apex_part);
  }
  /// Between which parts it is above a height; false: nowhere.
  bool above(float height, float& first, float& last) const {
    if (!(height < apex)) return false;
    const float reach = std::sqrt(1 - std::max(height, 0.0F) / apex);
    first = apex_part * (1 - reach);
    last = apex_part + (1 - apex_part) * reach;
    return true;
  }

 private:
  float square(float part) const {
    const float s = part < apex_part ? (apex_part - part) / apex_part : (part - apex_part) / (1 - apex_part);
    return s * s;
  }
};

/// How many steps of a way, by (ex, ey) cells each, stay in the block of a place.
int steps_in_block(const ErodibleBed& bed, float x, float y, float ex, float ey) {
  const auto steps = [&](float place, float each, int n) {
    const int block = static_cast<int>(place) / ErodibleBed::block_cells;
    const auto first = static_cast<float>(block * ErodibleBed::block_cells);
    const float last =
        std::min(first + ErodibleBed::block_cells, static_cast<float>(n)) - (bed.periodic() ? 0 : 0.5F);
    const float way = each > 0 ? last - place : place - first;
    return std::abs(each) > 1e-3F ? way / std::abs(each) : 1000.0F;
  };
  return static_cast<int>(std::min(steps(x, ex, bed.geometry().nx()), steps(y, ey, bed.geometry().ny())) -
                          0.05F);
}

}  // namespace

HopEnd walk_hop(const ErodibleBed& bed, const HopTable& table, const Drift::Cell& wind, float x, float y,
                const Eigen::Vector3f& velocity) {
  const GridGeometry& g = bed.geometry();
  const float along = std::max(0.0F, velocity.x() * wind.east + velocity.y() * wind.north);
  const float across = velocity.y() * wind.east - velocity.x() * wind.north;
  const Hop hop = table.at(along, velocity.z());
  const auto range = static_cast<float>(hop.range / g.cell());
  const auto aside = static_cast<float>(across * hop.lateral_time / g.cell());
  const float dx = range * wind.east - aside * wind.north;
  const float dy = range * wind.north + aside * wind.east;
  const float length = std::hypot(dx, dy);
  const auto end_across = static_cast<float>(across * hop.lateral_kept);

  const auto place = [&](float part, float& px, float& py) {
    px = x + part * dx;
    py = y + part * dy;
    if (bed.periodic()) {
      px = on_ring(px, g.nx());
      py = on_ring(py, g.ny());
    }
  };
  const auto end_at = [&](float part, float vertical) {
    HopEnd end{};
    place(part, end.x, end.y);
    const float u = along + (static_cast<float>(hop.along) - along) * std::min(part, 1.2F);
    end.velocity = {u * wind.east - end_across * wind.north, u * wind.north + end_across * wind.east,
                    vertical};
    end.way = part * range;
    end.outside =
        !bed.periodic() && !(end.x >= -0.5F && end.y >= -0.5F && end.x < static_cast<float>(g.nx()) - 0.5F &&
                             end.y < static_cast<float>(g.ny()) - 0.5F);
    return end;
  };
  const auto down = static_cast<float>(hop.down);
  if (!(hop.apex > 0 && length > 0.5F)) return end_at(1, -down);

  const Arc arc{static_cast<float>(hop.apex),
                std::clamp(static_cast<float>(hop.apex_distance / hop.range), 0.05F, 0.95F), velocity.z(),
                down};
  const float begin = height_at(bed, x, y);
  const float step = 1 / length;
  float free_from = 2, free_to = 2;
  arc.above(bed.highest() - begin, free_from, free_to);
  const auto above_all = [&](float at) { return at > free_from && at < free_to; };
  float before = 0;          // part of the range at the last place above the terrain
  float clear_before = 0;    // and how far above
  float part = 0.5F * step;  // what stands within half a cell is the slope that the hop began on
  for (int n = 0; n < most_steps; ++n) {
    if (above_all(part)) {
      // Nothing reaches up there.
      before = free_to;
      clear_before = arc.height(free_to) + begin - bed.highest();
      part = free_to;
      free_from = 2;
    }
    float px = 0, py = 0;
    place(part, px, py);
    if (!bed.periodic() && !(px >= -0.5F && py >= -0.5F && px < static_cast<float>(g.nx()) - 0.5F &&
                             py < static_cast<float>(g.ny()) - 0.5F))
      return end_at(part, arc.vertical(part));
    if (px >= 0 && py >= 0) {
      // Nor where the block is lower all the way through it.
      const float highest = bed.highest_of_block(static_cast<int>(px) / ErodibleBed::block_cells,
                                                 static_cast<int>(py) / ErodibleBed::block_cells);
      int free = begin + arc.height(part) > highest ? steps_in_block(bed, px, py, dx * step, dy * step) : 0;
      if (free > 0 && begin + arc.height(part + static_cast<float>(free) * step) > highest) {
        for (; free > 0 && !above_all(part); --free) part += step;
        if (above_all(part)) continue;
        place(part, px, py);
      }
    }
    const float clear = begin + arc.height(part) - height_at(bed, px, py);
    if (clear <= 0) {
      const float share = clear_before > 0 ? clear_before / (clear_before - clear) : 1;
      const float at = before + share * (part - before);
      return end_at(at, arc.vertical(at));
    }
    before = part;
    clear_before = clear;
    part += step;
  }
  return end_at(part, arc.vertical(part));
}

}  // namespace aeolian
