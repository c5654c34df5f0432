#include "aeolian_core/bedforms/erosion/hop_table.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr Require require{"hop table"};
constexpr double longest = 60;  ///< of a flight that is followed [s]

}  // namespace

Hop flown_hop(const HopWind& wind, double along, double up, double step) {
  Hop hop;
  if (!(up > 0)) return hop;
  const Grain& grain = wind.grain;
  const double drag =
      0.75 * wind.air.density / grain.density * wind.air.viscosity / (grain.diameter * grain.diameter);
  const double reynolds = grain.diameter / wind.air.viscosity;
  const double shear = wind.friction_velocity / von_karman;
  double x = 0, z = 0, u = along, w = up, across = 1, lateral = 0;
  for (double t = 0; t < longest; t += step) {
    const double air = z > wind.roughness ? shear * std::log(z / wind.roughness) : 0;
    const double re = reynolds * std::hypot(air - u, w);
    const double f = step * drag * (24 + re * (0.4 + 6 / (1 + std::sqrt(re))));
    const double nu = (u + f * air) / (1 + f);
    const double nw = (w - wind.air.gravity * step) / (1 + f);
    const double next_across = across / (1 + f);
    const double dx = 0.5 * step * (u + nu);
    const double dz = 0.5 * step * (w + nw);
    const double dy = 0.5 * step * (across + next_across);
    const double part = z + dz < 0 ? z / -dz : 1;
    if (w > 0 && nw <= 0) {
      const double rest = w / (w - nw);
      hop.apex = z + 0.5 * w * rest * step;
      hop.apex_distance = x + rest * dx;
    }
    x += part * dx;
    z += part * dz;
    lateral += part * dy;
    if (part < 1) {
      hop.range = x;
      hop.time = t + part * step;
      hop.along = u + part * (nu - u);
      hop.down = -(w + part * (nw - w));
      hop.lateral_time = lateral;
      hop.lateral_kept = across + part * (next_across - across);
      return hop;
    }
    u = nu;
    w = nw;
    across = next_across;
  }
  require.refuse("time of flight", longest, "less");
}

HopTable::HopTable(const HopWind& wind, double fastest, double highest, int nodes)
    : wind_(wind), nodes_(nodes) {
  require(fastest > 0 && std::isfinite(fastest), "fastest lift-off", fastest, "positive");
  require(highest > 0 && std::isfinite(highest), "highest lift-off", highest, "positive");
  require(nodes >= 2 && nodes <= 1000, "nodes", nodes, "2 to 1000");
  const double last = nodes - 1;
  along_scale_ = static_cast<float>(last / std::sqrt(fastest));
  up_scale_ = static_cast<float>(last / std::sqrt(highest));
  table_.reserve(static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes));
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < nodes; ++i) {
      const double along = fastest * (i / last) * (i / last);
      const double up = highest * (j / last) * (j / last);
      const double step = std::clamp(up / wind.air.gravity / 40, 2e-6, 5e-4);
      const Hop h = flown_hop(wind, along, up, step);
      Node node;
      const double all[values] = {h.range, h.time, h.apex,         h.apex_distance,
                                  h.along, h.down, h.lateral_time, h.lateral_kept};
      std::transform(all, all + values, node.begin(), [](double v) { return static_cast<float>(v); });
      // A grain that does not rise comes down at once as it was.
      if (j == 0) {
        node[4] = static_cast<float>(along);
        node[7] = 1;
      }
      table_.push_back(node);
    }
}

Hop HopTable::at(float along, float up) const {
  const auto last = static_cast<float>(nodes_ - 1);
  const float a = std::min(std::sqrt(std::max(along, 0.0F)) * along_scale_, last);
  const float b = std::min(std::sqrt(std::max(up, 0.0F)) * up_scale_, last);
  const int i = std::min(static_cast<int>(a), nodes_ - 2);
  const int j = std::min(static_cast<int>(b), nodes_ - 2);
  const float s = a - static_cast<float>(i);
  const float t = b - static_cast<float>(j);
  const Node* south =
      &table_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_) + static_cast<std::size_t>(i)];
  const Node* north = south + nodes_;
  float v[values];
  for (std::size_t n = 0; n < values; ++n) {
    const float low = south[0][n] + s * (south[1][n] - south[0][n]);
    const float high = north[0][n] + s * (north[1][n] - north[0][n]);
    v[n] = low + t * (high - low);
  }
  return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
}

}  // namespace aeolian
