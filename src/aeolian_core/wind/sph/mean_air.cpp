#include "aeolian_core/wind/sph/mean_air.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/wind/sph/lattice.hpp"

namespace aeolian::sph {
namespace {

/// Of the kernel's sum: a point on a wall has half of it.
constexpr float least_air = 0.25F;
constexpr float least_told = 0.02F;

}  // namespace

AirProbe probe(const SphAir& air, const Four& at) {
  const Wendland& kernel = air.neighbours().kernel();
  AirProbe result;
  for_near(air.cells(), air.place(), at, kernel.support, [&](std::size_t i, const Four& way) {
    const float w = air.neighbours().volume() * kernel.value(std::sqrt(dot3(way, way)));
    result.air += w;
    result.velocity += w * (air.motion()[i] - air.slope(0)[i] * way[0] - air.slope(1)[i] * way[1] -
                            air.slope(2)[i] * way[2]);
  });
  result.valid = result.air >= least_air;
  if (result.air > 0) result.velocity /= result.air;
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
    for (int x = 0; x < nx_; ++x)
      for (int z = 0; z <= nz_; ++z) {
        const AirProbe p = probe(
            air, Four{static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, static_cast<float>(z), 0});
        // A site in the ground takes what the nearest air would have there.
        if (p.air < least_told) continue;
        sum_[index(x, y, z)] += p.velocity;
        count_[index(x, y, z)] += 1;
      }
  });
}

Four MeanAir::at(float x, float y, float z) const {
  const float fx = std::floor(x - 0.5F);
  const float fy = std::floor(y - 0.5F);
  z = std::clamp(z, 0.0F, static_cast<float>(nz_));
  const int low = std::min(static_cast<int>(z), nz_ - 1);
  const float part[3] = {x - 0.5F - fx, y - 0.5F - fy, z - static_cast<float>(low)};
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
