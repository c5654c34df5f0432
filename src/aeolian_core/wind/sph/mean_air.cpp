#include "aeolian_core/wind/sph/mean_air.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/wind/sph/lattice.hpp"

namespace aeolian::sph {
namespace {

constexpr float least_air = 0.25F;     ///< of the kernel's sum: a point on a wall has half of it
constexpr float least_spread = 0.01F;  ///< determinant of the scatter of particles, by that within the air

}  // namespace

AirProbe probe(const SphAir& air, const Four& at) {
  const Wendland& kernel = air.neighbours().kernel();
  AirProbe result;
  Four middle{};
  Four square[3] = {};
  Four with[3] = {};  // The velocity times each coordinate.
  for_near(air.cells(), air.place(), at, kernel.support, [&](std::size_t i, const Four& way) {
    const float w = air.neighbours().volume() * kernel.value(std::sqrt(dot3(way, way)));
    const Four u = air.motion()[i];
    result.air += w;
    result.velocity += w * u;
    middle += w * way;
    for (int axis = 0; axis < 3; ++axis) {
      square[axis] += (w * way[axis]) * way;
      with[axis] += (w * way[axis]) * u;
    }
  });
  result.valid = result.air >= least_air;
  if (!(result.air > 0)) return result;
  const float by = 1 / result.air;
  result.velocity *= by;
  middle *= by;
  // In units of the kernel's own scatter, h^2/15 along each axis.
  const float scatter = 15 / (kernel.support * kernel.support);
  for (int axis = 0; axis < 3; ++axis) {
    square[axis] = scatter * (by * square[axis] - middle[axis] * middle);
    with[axis] = scatter * (by * with[axis] - middle[axis] * result.velocity);
  }
  Four inverse[3];
  if (!result.valid || !invert(square, least_spread, inverse)) return result;
  for (int axis = 0; axis < 3; ++axis) result.velocity -= dot3(inverse[axis], middle) * with[axis];
  return result;
}

MeanAir::MeanAir(const SphAir& air)
    : nx_(air.ground().place().nx), ny_(air.ground().place().ny), nz_(air.ground().place().nz) {
  sum_.assign(index(nx_ - 1, ny_ - 1, nz_) + 1, Four{});
  count_.assign(sum_.size(), 0);
}

std::size_t MeanAir::index(int x, int y, int z) const {
  return (static_cast<std::size_t>((y % ny_ + ny_) % ny_) * static_cast<std::size_t>(nx_) +
          static_cast<std::size_t>((x % nx_ + nx_) % nx_)) *
             static_cast<std::size_t>(nz_ + 1) +
         static_cast<std::size_t>(z);
}

void MeanAir::add(const SphAir& air) {
  tbb::parallel_for(0, ny_, [&](int y) {
    for (int x = 0; x < nx_; ++x) {
      const float px = static_cast<float>(x) + 0.5F;
      const float py = static_cast<float>(y) + 0.5F;
      const float ground = air.ground().height(px, py);
      for (int level = 0; level <= nz_; ++level) {
        const float z = ground + static_cast<float>(level);
        if (z > static_cast<float>(nz_)) break;
        const AirProbe p = probe(air, Four{px, py, z, 0});
        if (!p.valid) continue;
        sum_[index(x, y, level)] += p.velocity;
        count_[index(x, y, level)] += 1;
      }
    }
  });
}

Four MeanAir::at(float x, float y, float height) const {
  const float fx = std::floor(x - 0.5F);
  const float fy = std::floor(y - 0.5F);
  height = std::clamp(height, 0.0F, static_cast<float>(nz_));
  const int low = std::min(static_cast<int>(height), nz_ - 1);
  const float part[3] = {x - 0.5F - fx, y - 0.5F - fy, height - static_cast<float>(low)};
  Four sum{};
  float weights = 0;
  for (int n = 0; n < 8; ++n) {
    const std::size_t i =
        index(static_cast<int>(fx) + (n & 1), static_cast<int>(fy) + (n >> 1 & 1), low + (n >> 2 & 1));
    const float w =
        (n & 1 ? part[0] : 1 - part[0]) * (n & 2 ? part[1] : 1 - part[1]) * (n & 4 ? part[2] : 1 - part[2]);
    if (!(count_[i] > 0)) continue;
    weights += w;
    sum += (w / count_[i]) * sum_[i];
  }
  if (!(weights > 0)) return Four{NAN, NAN, NAN, 0};
  return sum / weights;
}

}  // namespace aeolian::sph
