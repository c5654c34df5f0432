#include "aeolian_core/measure/point_locator.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/measure/kernel.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {
namespace {

constexpr std::size_t batch = PointLocator::batch;

struct Placed {
  double x[batch];        ///< [cells]
  double y[batch];        ///< [cells]
  double height[batch];   ///< [steps]
  double squared[batch];  ///< range [m^2]
  float rise[batch];      ///< over the sensor [m]
  std::int32_t weight[batch];
  std::int32_t fate[batch];  ///< used, outside, out_of_range or not_finite
};

/// What becomes of a point, as numbers that loops can choose between.
constexpr int used = 0;
constexpr int outside = 1;
constexpr int out_of_range = 2;
constexpr int not_finite = 3;

AEOLIAN_KERNEL void place(const PointLocator& l, const float* __restrict px, const float* __restrict py,
                          const float* __restrict pz, std::size_t count, Placed& __restrict placed) {
  const double ox = l.origin[0], oy = l.origin[1], oz = l.origin[2];
  const double r0 = l.rotation[0], r1 = l.rotation[1], r2 = l.rotation[2];
  const double r3 = l.rotation[3], r4 = l.rotation[4], r5 = l.rotation[5];
  const double r6 = l.rotation[6], r7 = l.rotation[7], r8 = l.rotation[8];
  const double tx = l.offset[0], ty = l.offset[1], tz = l.offset[2];
  const double per_cell = l.per_cell;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = ox + static_cast<double>(px[i]);
    const double y = oy + static_cast<double>(py[i]);
    const double z = oz + static_cast<double>(pz[i]);
    const double rise = r6 * x + r7 * y + r8 * z;
    placed.x[i] = (r0 * x + r1 * y + r2 * z + tx) * per_cell;
    placed.y[i] = (r3 * x + r4 * y + r5 * z + ty) * per_cell;
    placed.height[i] = (rise + tz) * fixed::steps_per_metre;
    placed.squared[i] = x * x + y * y + z * z;
    placed.rise[i] = static_cast<float>(rise);
  }
}

/// Takes the bias off along the rays: towards the sensor by bias / range of the way.
AEOLIAN_KERNEL void take_off_bias(const PointLocator& l, std::size_t count, Placed& placed) {
  const double bias = l.noise.range_bias;
  const double sensor_x = l.offset[0] * l.per_cell;
  const double sensor_y = l.offset[1] * l.per_cell;
  const double sensor_z = l.offset[2] * fixed::steps_per_metre;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = bias / std::sqrt(placed.squared[i]);
    placed.x[i] -= share * (placed.x[i] - sensor_x);
    placed.y[i] -= share * (placed.y[i] - sensor_y);
    placed.height[i] -= share * (placed.height[i] - sensor_z);
  }
}

AEOLIAN_KERNEL void judge(const PointLocator& l, std::size_t count, Placed& __restrict placed) {
  const double nx = l.nx, ny = l.ny;
  const double nearest = l.georeferenced ? -1 : l.nearest;
  const double farthest = l.georeferenced ? 1e300 : l.farthest;
  const double zero = l.georeferenced ? -1 : 1e-12;  // what drivers write for nothing seen
  constexpr double high = fixed::greatest_height * fixed::steps_per_metre;
  for (std::size_t i = 0; i < count; ++i) {
    const double squared = placed.squared[i];
    const double height = placed.height[i];
    const double x = placed.x[i];
    const double y = placed.y[i];
    // The worst last: a choice of doubles, which vectors can make.
    double fate = used;
    fate = (x >= 0) & (y >= 0) & (x < nx) & (y < ny) ? fate : outside;
    fate = (squared >= nearest) & (squared <= farthest) ? fate : out_of_range;
    fate = (squared > zero) & (height >= -high) & (height <= high) ? fate : out_of_range;
    fate = squared <= 1e300 ? fate : not_finite;
    placed.fate[i] = static_cast<std::int32_t>(fate);
    placed.x[i] = fate > 0 ? 0 : x;
    placed.y[i] = fate > 0 ? 0 : y;
    placed.height[i] = fate > 0 ? 0 : height;
  }
}

AEOLIAN_KERNEL void weigh(const PointLocator& l, std::size_t count, Placed& placed) {
  const SensorNoise& n = l.noise;
  constexpr auto m2 = static_cast<float>(SensorNoise::bed_slope * SensorNoise::bed_slope);
  constexpr auto least = static_cast<float>(SensorNoise::least_cosine);
  constexpr auto greatest = static_cast<float>(fixed::greatest_weight);
  const auto s0 = static_cast<float>(n.range_sigma);
  const auto s1 = static_cast<float>(n.range_sigma_per_metre);
  const auto s2 = static_cast<float>(n.range_sigma_per_square_metre);
  const auto angular = static_cast<float>(n.angular_sigma);
  const auto growth = static_cast<float>(n.incidence_growth);
  const auto scale = static_cast<float>(fixed::reference_weight * l.reference_variance);
  for (std::size_t i = 0; i < count; ++i) {
    const float range = std::sqrt(static_cast<float>(placed.squared[i]));
    const float cosine = std::abs(placed.rise[i]) / range;
    const float bounded = cosine > least ? cosine : least;
    const float along = (s0 + range * (s1 + range * s2)) * (1 + growth * (1 / bounded - 1));
    const float across = range * angular;
    const float cos2 = cosine * cosine;
    const float sin2 = 1 - cos2;
    const float variance = along * along * (cos2 + m2 * sin2) + across * across * (sin2 + m2 * cos2);
    float weight = scale / variance + 0.5F;
    weight = weight > 1 ? weight : 1;  // also for NaN
    weight = weight < greatest ? weight : greatest;
    placed.weight[i] = static_cast<std::int32_t>(weight);
  }
}

struct Packed {
  std::int32_t cell[batch];
  std::int32_t height[batch];
};

AEOLIAN_KERNEL void pack(const PointLocator& l, std::size_t count, const Placed& __restrict placed,
                         Packed& __restrict packed, std::int32_t* __restrict tile) {
  constexpr int side = TileMask::tile_cells;
  const int tiles_x = l.tiles_x;
  for (std::size_t i = 0; i < count; ++i) {
    const auto ix = static_cast<std::int32_t>(placed.x[i]);
    const auto iy = static_cast<std::int32_t>(placed.y[i]);
    const double height = placed.height[i];
    packed.cell[i] = (iy & (side - 1)) * side + (ix & (side - 1));
    packed.height[i] = static_cast<std::int32_t>(height + (height < 0 ? -0.5 : 0.5));
    const std::int32_t at = (iy / side) * tiles_x + ix / side;
    tile[i] = placed.fate[i] == used ? at : PointLocator::nowhere;
  }
}

AEOLIAN_KERNEL PointCounts count_fates(std::size_t count, const std::int32_t* fate) {
  std::int32_t lost = 0;
  for (std::size_t i = 0; i < count; ++i) lost |= fate[i];
  if (lost == 0) return {count, 0, 0, 0};
  std::int32_t of_used = 0, of_outside = 0, of_range = 0, of_infinite = 0;
  for (std::size_t i = 0; i < count; ++i) {
    of_used += fate[i] == used ? 1 : 0;
    of_outside += fate[i] == outside ? 1 : 0;
    of_range += fate[i] == out_of_range ? 1 : 0;
    of_infinite += fate[i] == not_finite ? 1 : 0;
  }
  const auto size = [](std::int32_t n) { return static_cast<std::size_t>(n); };
  return {size(of_used), size(of_infinite), size(of_range), size(of_outside)};
}

}  // namespace

PointCounts PointLocator::locate(const float* x, const float* y, const float* z, std::size_t count,
                                 std::int32_t* tile, Sample* sample) const {
  Placed placed;
  place(*this, x, y, z, count, placed);
  if (noise.range_bias != 0 && !georeferenced) take_off_bias(*this, count, placed);
  judge(*this, count, placed);
  if (georeferenced) {
    const double weight =
        fixed::reference_weight * reference_variance / (noise.range_sigma * noise.range_sigma);
    std::fill_n(placed.weight, count,
                static_cast<std::int32_t>(std::clamp(weight + 0.5, 1.0, fixed::greatest_weight)));
  } else {
    weigh(*this, count, placed);
  }
  Packed packed;
  pack(*this, count, placed, packed, tile);
  for (std::size_t i = 0; i < count; ++i)
    sample[i] = Sample(static_cast<std::uint32_t>(packed.cell[i]), packed.height[i],
                       static_cast<std::uint32_t>(placed.weight[i]));
  return count_fates(count, placed.fate);
}

}  // namespace aeolian
