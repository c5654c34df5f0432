#include "aeolian_core/measure/point_locator.hpp"

#include <cmath>
#include <limits>

#include "aeolian_core/surface/kernel.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {
namespace {

constexpr std::size_t batch = PointLocator::batch;

struct Placed {
  std::int32_t x[batch];       ///< [cells], -1 or past the last: outside
  std::int32_t y[batch];       ///< likewise
  std::int32_t height[batch];  ///< [steps]
  float squared[batch];        ///< range [m^2]
  float range[batch];          ///< [m]
  float rise[batch];           ///< over the sensor [m]
  std::int32_t weight[batch];
  std::int32_t fate[batch];  ///< used, outside, out_of_range or not_finite
};

/// What becomes of a point, as numbers that loops can choose between.
constexpr int used = 0;
constexpr int outside = 1;
constexpr int out_of_range = 2;
constexpr int not_finite = 3;

constexpr double high = fixed::greatest_height * fixed::steps_per_metre;

/// Ranges, which may be floats: they only weigh.
AEOLIAN_WIDE_KERNEL void measure(const PointLocator& l, const float* __restrict px,
                                 const float* __restrict py, const float* __restrict pz, std::size_t count,
                                 Placed& __restrict placed) {
  const auto ox = static_cast<float>(l.origin[0]);
  const auto oy = static_cast<float>(l.origin[1]);
  const auto oz = static_cast<float>(l.origin[2]);
  const auto r6 = static_cast<float>(l.rotation[6]);
  const auto r7 = static_cast<float>(l.rotation[7]);
  const auto r8 = static_cast<float>(l.rotation[8]);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = ox + px[i];
    const float y = oy + py[i];
    const float z = oz + pz[i];
    const float squared = x * x + y * y + z * z;
    placed.squared[i] = squared;
    placed.range[i] = std::sqrt(squared);
    placed.rise[i] = r6 * x + r7 * y + r8 * z;
  }
}

inline double within(double value, double low, double top) {
  const double above = value > low ? value : low;  // also for NaN
  return above < top ? above : top;
}

/// Cells and heights; the bias is taken off along the rays.
AEOLIAN_WIDE_KERNEL void place(const PointLocator& l, const float* __restrict px, const float* __restrict py,
                               const float* __restrict pz, std::size_t count, Placed& __restrict placed) {
  const double ox = l.origin[0], oy = l.origin[1], oz = l.origin[2];
  const double to_cells = l.per_cell;
  const double r0 = l.rotation[0] * to_cells, r1 = l.rotation[1] * to_cells, r2 = l.rotation[2] * to_cells;
  const double r3 = l.rotation[3] * to_cells, r4 = l.rotation[4] * to_cells, r5 = l.rotation[5] * to_cells;
  const double to_steps = fixed::steps_per_metre;
  const double r6 = l.rotation[6] * to_steps, r7 = l.rotation[7] * to_steps, r8 = l.rotation[8] * to_steps;
  const double tx = l.offset[0] * to_cells, ty = l.offset[1] * to_cells, tz = l.offset[2] * to_steps;
  const double nx = l.nx, ny = l.ny;
  const float bias = l.georeferenced ? 0 : static_cast<float>(l.noise.range_bias);
  for (std::size_t i = 0; i < count; ++i) {
    const double kept = 1 - static_cast<double>(bias / placed.range[i]);
    const double x = kept * (ox + static_cast<double>(px[i]));
    const double y = kept * (oy + static_cast<double>(py[i]));
    const double z = kept * (oz + static_cast<double>(pz[i]));
    placed.x[i] = static_cast<std::int32_t>(std::floor(within(r0 * x + r1 * y + r2 * z + tx, -1, nx)));
    placed.y[i] = static_cast<std::int32_t>(std::floor(within(r3 * x + r4 * y + r5 * z + ty, -1, ny)));
    const double height = within(r6 * x + r7 * y + r8 * z + tz, -high - 1, high + 1);
    placed.height[i] = static_cast<std::int32_t>(std::floor(height + 0.5));
  }
}

AEOLIAN_WIDE_KERNEL void judge(const PointLocator& l, const float* __restrict px, const float* __restrict py,
                               const float* __restrict pz, std::size_t count, Placed& __restrict placed) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const float nearest = l.georeferenced ? -1 : static_cast<float>(l.nearest);
  const float farthest = l.georeferenced ? infinite : static_cast<float>(l.farthest);
  const float zero = l.georeferenced ? -1 : 1e-12F;  // what drivers write for nothing seen
  constexpr auto greatest = static_cast<std::int32_t>(high);
  const int nx = l.nx, ny = l.ny;
  for (std::size_t i = 0; i < count; ++i) {
    const float squared = placed.squared[i];
    const std::int32_t height = placed.height[i];
    const std::int32_t x = placed.x[i];
    const std::int32_t y = placed.y[i];
    std::int32_t fate = used;  // the worst last
    fate = (x >= 0) & (y >= 0) & (x < nx) & (y < ny) ? fate : outside;
    fate = (squared >= nearest) & (squared <= farthest) & (squared > zero) ? fate : out_of_range;
    fate = (height >= -greatest) & (height <= greatest) ? fate : out_of_range;
    fate = 0 * px[i] + 0 * py[i] + 0 * pz[i] == 0 ? fate : not_finite;
    placed.fate[i] = fate;
  }
}

AEOLIAN_WIDE_KERNEL void weigh(const PointLocator& l, std::size_t count, Placed& __restrict placed) {
  const SensorNoise& n = l.noise;
  const bool rays = !l.georeferenced;  // without them the variance is range_sigma^2 in any direction
  const float m2 = rays ? static_cast<float>(SensorNoise::bed_slope * SensorNoise::bed_slope) : 1;
  const auto s0 = static_cast<float>(n.range_sigma);
  const auto s1 = rays ? static_cast<float>(n.range_sigma_per_metre) : 0;
  const auto s2 = rays ? static_cast<float>(n.range_sigma_per_square_metre) : 0;
  const auto angular = rays ? static_cast<float>(n.angular_sigma) : 0;
  const auto growth = rays ? static_cast<float>(n.incidence_growth) : 0;
  constexpr auto least = static_cast<float>(SensorNoise::least_cosine);
  constexpr auto greatest = static_cast<float>(fixed::greatest_weight);
  const auto scale = static_cast<float>(fixed::reference_weight * l.reference_variance);
  for (std::size_t i = 0; i < count; ++i) {
    const float range = placed.range[i];
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

AEOLIAN_WIDE_KERNEL void pack(const PointLocator& l, std::size_t count, const Placed& __restrict placed,
                              std::int32_t* __restrict tile, Sample* __restrict sample) {
  constexpr int side = TileMask::tile_cells;
  const int tiles_x = l.tiles_x;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t x = placed.x[i];
    const std::int32_t y = placed.y[i];
    const std::int32_t at = (y / side) * tiles_x + x / side;
    const std::int32_t cell = (y & (side - 1)) * side + (x & (side - 1));
    tile[i] = placed.fate[i] == used ? at : PointLocator::nowhere;
    sample[i] = Sample(static_cast<std::uint32_t>(cell), placed.height[i],
                       static_cast<std::uint32_t>(placed.weight[i]));
  }
}

AEOLIAN_WIDE_KERNEL PointCounts count_fates(std::size_t count, const std::int32_t* fate) {
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
  measure(*this, x, y, z, count, placed);
  place(*this, x, y, z, count, placed);
  judge(*this, x, y, z, count, placed);
  weigh(*this, count, placed);
  pack(*this, count, placed, tile, sample);
  return count_fates(count, placed.fate);
}

}  // namespace aeolian
