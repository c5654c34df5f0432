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
  const float begin = patch_at(bed, x, y).height;
  const float step = 1 / length;
  float free_from = 2, free_to = 2;
  arc.above(bed.highest() - begin, free_from, free_to);
  float before = 0;          // part of the range at the last place above the terrain
  float clear_before = 0;    // and how far above
  float part = 0.5F * step;  // what stands within half a cell is the slope that the hop began on
  for (int n = 0; n < most_steps; ++n) {
    if (part > free_from && part < free_to) {
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
    const float clear = begin + arc.height(part) - patch_at(bed, px, py).height;
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
