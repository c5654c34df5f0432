#include "aeolian_core/wind/sph/mean_air.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/wind/sph/lattice.hpp"

namespace aeolian::sph {
namespace {

/// Of the kernel's sum: a point on a wall has half of it.
constexpr float least_air = 0.25F;

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

MeanAir::MeanAir(const SphAir& air, int levels)
    : nx_(air.ground().place().nx), ny_(air.ground().place().ny), levels_(levels) {
  const std::size_t n =
      static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(levels + 1);
  sum_.assign(n, Four{});
  count_.assign(n, 0);
}

std::size_t MeanAir::index(int x, int y, int level) const {
  return (static_cast<std::size_t>((y % ny_ + ny_) % ny_) * static_cast<std::size_t>(nx_) +
          static_cast<std::size_t>((x % nx_ + nx_) % nx_)) *
             static_cast<std::size_t>(levels_ + 1) +
         static_cast<std::size_t>(level);
}

void MeanAir::add(const SphAir& air) {
  ++asked_;
  tbb::parallel_for(0, ny_, [&](int y) {
    for (int x = 0; x < nx_; ++x) {
      const float px = static_cast<float>(x) + 0.5F;
      const float py = static_cast<float>(y) + 0.5F;
      const float ground = air.ground().height(px, py);
      for (int level = 0; level <= levels_; ++level) {
        const AirProbe p = probe(air, Four{px, py, ground + static_cast<float>(level), 0});
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
  const float z = std::clamp(height, 0.0F, static_cast<float>(levels_));
  const int low = std::min(static_cast<int>(z), levels_ - 1);
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

double MeanAir::invalid_share() const {
  double found = 0;
  for (const float c : count_) found += static_cast<double>(c);
  return 1 -
         found / (static_cast<double>(count_.size()) * static_cast<double>(std::max<std::size_t>(asked_, 1)));
}

}  // namespace aeolian::sph
