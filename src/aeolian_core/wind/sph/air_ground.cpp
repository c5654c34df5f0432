#include "aeolian_core/wind/sph/air_ground.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian::sph {
namespace {

constexpr int foot_tries = 3;
constexpr float wall = 0.25F;  ///< ground that rises more than this above the nearest plane may be nearer

/// How much of the relief is left at a distance from a border, and its slope.
struct Blend {
  float part, slope;
};
Blend blend(float at, float length, float ring, float width) {
  if (ring <= 0) return {1, 0};
  const float mirrored = length - at;
  const float t = (std::min(at, mirrored) - ring) / width;
  if (t <= 0) return {0, 0};
  if (t >= 1) return {1, 0};
  const float slope = 6 * t * (1 - t) / width;
  return {t * t * (3 - 2 * t), at < mirrored ? slope : -slope};
}

}  // namespace

AirGround::AirGround(const WindRelief& relief, const BoxPlace& place)
    : geometry_(relief.geometry), place_(place) {
  const GridGeometry& g = relief.geometry;
  cells_ = static_cast<float>(place.spacing / g.cell());
  height_.reserve(relief.height.size());
  for (const double h : relief.height)
    height_.push_back(static_cast<float>((h - place.floor) / place.spacing));
  double sum = 0;
  double count = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const bool border = (place.ring_x > 0 && (x == 0 || x == g.nx() - 1)) ||
                          (place.ring_y > 0 && (y == 0 || y == g.ny() - 1));
      if (border) sum += static_cast<double>(height_[g.index(x, y)]);
      if (border) ++count;
      const float here = height_[g.index(x, y)];
      if (x > 0) steepest_ = std::max(steepest_, std::abs(here - height_[g.index(x - 1, y)]) * cells_);
      if (y > 0) steepest_ = std::max(steepest_, std::abs(here - height_[g.index(x, y - 1)]) * cells_);
    }
  highest_ = *std::max_element(height_.begin(), height_.end());
  level_ = count > 0 ? static_cast<float>(sum / count) : height_.front();
  // What the blend adds to the slope of the relief.
  const float relief_height = highest_ - *std::min_element(height_.begin(), height_.end());
  steepest_ += 1.5F * relief_height * (1 / place.blend_x + 1 / place.blend_y);
  move(place.x, place.y);
}

void AirGround::move(double x, double y) {
  place_.x = x;
  place_.y = y;
  const GridGeometry& g = geometry_;
  origin_x_ = static_cast<float>((x - g.origin_x()) / g.cell() - 0.5);
  origin_y_ = static_cast<float>((y - g.origin_y()) / g.cell() - 0.5);
}

AirGround::Surface AirGround::relief(float x, float y) const {
  const GridGeometry& g = geometry_;
  const float last_x = static_cast<float>(g.nx() - 1);
  const float last_y = static_cast<float>(g.ny() - 1);
  const float at_x = origin_x_ + x * cells_;
  const float at_y = origin_y_ + y * cells_;
  const float fx = std::clamp(at_x, 0.0F, last_x);
  const float fy = std::clamp(at_y, 0.0F, last_y);
  const int ix = std::min(static_cast<int>(fx), std::max(g.nx() - 2, 0));
  const int iy = std::min(static_cast<int>(fy), std::max(g.ny() - 2, 0));
  const float wx = fx - static_cast<float>(ix);
  const float wy = fy - static_cast<float>(iy);
  const std::size_t i = g.index(ix, iy);
  const std::size_t right = g.nx() > 1 ? 1 : 0;
  const std::size_t above = g.ny() > 1 ? static_cast<std::size_t>(g.nx()) : 0;
  const float a = height_[i];
  const float b = height_[i + right];
  const float c = height_[i + above];
  const float d = height_[i + above + right];
  const float south = a + wx * (b - a);
  const float north = c + wx * (d - c);
  Surface s{south + wy * (north - south), 0, 0};
  if (fx == at_x) s.slope_x = ((1 - wy) * (b - a) + wy * (d - c)) * cells_;
  if (fy == at_y) s.slope_y = (north - south) * cells_;
  return s;
}

AirGround::Surface AirGround::surface(float x, float y) const {
  const Blend bx = blend(x, static_cast<float>(place_.nx), place_.ring_x, place_.blend_x);
  const Blend by = blend(y, static_cast<float>(place_.ny), place_.ring_y, place_.blend_y);
  const float part = bx.part * by.part;
  if (part <= 0) return {level_, 0, 0};
  const Surface s = relief(x, y);
  const float rise = s.z - level_;
  return {level_ + part * rise, part * s.slope_x + bx.slope * by.part * rise,
          part * s.slope_y + bx.part * by.slope * rise};
}

AirGround::Foot AirGround::foot(const Four& at, float x, float y, float reach) const {
  Foot f{x, y, 0, 0, 0};
  for (int n = 0;; ++n) {
    const Surface s = surface(f.x, f.y);
    f.z = s.z;
    f.slope_x = s.slope_x;
    f.slope_y = s.slope_y;
    if (n == foot_tries) return f;
    // The perpendicular to the plane that touches the ground here.
    const float over = at[2] - s.z - s.slope_x * (at[0] - f.x) - s.slope_y * (at[1] - f.y);
    const float part = over / (1 + s.slope_x * s.slope_x + s.slope_y * s.slope_y);
    f.x = std::clamp(at[0] + part * s.slope_x, at[0] - reach, at[0] + reach);
    f.y = std::clamp(at[1] + part * s.slope_y, at[1] - reach, at[1] + reach);
  }
}

void AirGround::nearest(Four& at, Four& normal, float reach) const {
  const float far = 4 * reach;
  normal = Four{0, 0, 1, 0};
  at[3] = far;
  if (at[2] > highest_ + reach) return;
  const Surface below = surface(at[0], at[1]);
  const float over = at[2] - below.z;
  if (over > reach * std::sqrt(1 + steepest_ * steepest_)) return;
  const auto square = [&](const Foot& f) {
    const float dx = at[0] - f.x;
    const float dy = at[1] - f.y;
    const float dz = at[2] - f.z;
    return dx * dx + dy * dy + dz * dz;
  };
  Foot best = foot(at, at[0], at[1], reach);
  float least = square(best);
  const float away = 0.6F * reach;
  for (int side = 0; side < 4 && steepest_ > 0.5F; ++side) {
    const float dx = side == 0 ? away : side == 1 ? -away : 0;
    const float dy = side == 2 ? away : side == 3 ? -away : 0;
    const float rise = height(at[0] + dx, at[1] + dy) - below.z;
    const float beyond = rise - below.slope_x * dx - below.slope_y * dy;
    if (over >= 0 ? beyond < wall : beyond > -wall) continue;
    const Foot other = foot(at, at[0] + dx, at[1] + dy, reach);
    const float s = square(other);
    if (s < least) {
      least = s;
      best = other;
    }
  }
  const float distance = std::sqrt(least);
  if (distance > reach && over >= 0) return;
  at[3] = over < 0 ? -distance : distance;
  const float length = std::sqrt(1 + best.slope_x * best.slope_x + best.slope_y * best.slope_y);
  normal = Four{-best.slope_x / length, -best.slope_y / length, 1 / length, 0};
  if (distance > 0.05F) {
    const float part = (over < 0 ? -1 : 1) / distance;
    normal = Four{part * (at[0] - best.x), part * (at[1] - best.y), part * (at[2] - best.z), 0};
  }
}

}  // namespace aeolian::sph
