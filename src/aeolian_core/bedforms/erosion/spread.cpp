#include "aeolian_core/bedforms/erosion/spread.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

int on_axis(int i, int n, bool periodic) {
  if (!periodic) return std::clamp(i, 0, n - 1);
  return i < 0 ? i + n : i >= n ? i - n : i;
}

}  // namespace

Spread::Spread(const ErodibleBed& bed, float x, float y, bool bilinear) {
  const int nx = bed.geometry().nx();
  const int ny = bed.geometry().ny();
  // Four different cells, or what is taken from one would be counted twice.
  count_ = bilinear && nx > 1 && ny > 1 ? 4 : 1;
  if (!bed.periodic()) {
    x = std::clamp(x, 0.0F, static_cast<float>(nx - 1));
    y = std::clamp(y, 0.0F, static_cast<float>(ny - 1));
  }
  const auto before = [&bed](float place, int n) {
    const int i = static_cast<int>(std::floor(place));
    return bed.periodic() ? i : std::min(i, std::max(n - 2, 0));
  };
  const int west = before(x, nx);
  const int south = before(y, ny);
  const float tx = x - static_cast<float>(west);
  const float ty = y - static_cast<float>(south);
  const int near_x = tx < 0.5F ? 0 : 1;
  const int near_y = ty < 0.5F ? 0 : 1;
  for (int n = 0; n < count_; ++n) {
    const int dx = n & 1 ? 1 - near_x : near_x;
    const int dy = n & 2 ? 1 - near_y : near_y;
    const auto i = static_cast<std::size_t>(n);
    cells_[i] = {on_axis(west + dx, nx, bed.periodic()), on_axis(south + dy, ny, bed.periodic())};
    weights_[i] = (dx ? tx : 1 - tx) * (dy ? ty : 1 - ty);
  }
}

std::array<std::int32_t, 4> Spread::divide(std::int32_t units) const {
  std::array<std::int32_t, 4> parts{units, 0, 0, 0};
  for (std::size_t n = 1; n < static_cast<std::size_t>(count_); ++n) {
    parts[n] = static_cast<std::int32_t>(static_cast<float>(units) * weights_[n]);
    parts[0] -= parts[n];
  }
  return parts;
}

std::int32_t Spread::take_loose(ErodibleBed& bed, std::int32_t units) const {
  std::int32_t taken = 0;
  const std::array<std::int32_t, 4> parts = divide(units);
  for (std::size_t n = 0; n < static_cast<std::size_t>(count_); ++n) {
    const std::int32_t part = std::min(parts[n], bed.loose(bed.geometry().index(cells_[n])));
    if (part <= 0) continue;
    bed.add_loose(cells_[n], -part);
    taken += part;
  }
  return taken;
}

bool Spread::take_parcel(ErodibleBed& bed, std::int32_t units) const {
  std::int32_t there = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(count_); ++n)
    there += bed.loose(bed.geometry().index(cells_[n]));
  const std::size_t nearest = bed.geometry().index(cells_[0]);
  if (there < units) {
    if (bed.sintered(nearest) < units) return false;
    bed.add_sintered(nearest, -units);
    return true;
  }
  std::int32_t left = units - take_loose(bed, units);
  for (std::size_t n = 0; left > 0 && n < static_cast<std::size_t>(count_); ++n) {
    const std::int32_t part = std::min(left, bed.loose(bed.geometry().index(cells_[n])));
    bed.add_loose(cells_[n], -part);
    left -= part;
  }
  return true;
}

}  // namespace aeolian
