#include "aeolian_core/bedforms/erosion/parcel_flight.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// ln(x) of x >= 1 to 1e-5: the exponent's part and four terms of the series in (m - 1) / (m + 1). Cheaper
/// than a table in memory.
AEOLIAN_INLINE float logarithm(float x) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const auto exponent = static_cast<float>((bits >> 23) - 127);
  bits = (bits & 0x007fffff) | 0x3f800000;
  float m = 0;
  std::memcpy(&m, &bits, sizeof m);
  const float t = (m - 1.0F) / (m + 1.0F);
  const float t2 = t * t;
  return 0.69314718F * exponent + t * (2.0F + t2 * (0.66666667F + t2 * (0.4F + t2 * 0.28571429F)));
}

AEOLIAN_INLINE float above_zero(float x) { return x > 0 ? x : 0.0F; }
AEOLIAN_INLINE float at_most(float x, float most) { return x < most ? x : most; }

/// The state of one parcel.
struct State {
  float x, y, z, u, v, w;
};

/// Its clearance goes to `above`.
AEOLIAN_INLINE State moved(const State& p, const ParcelStep& s, const float* surface, const float* shear,
                           bool uniform, float& above) {
  const float cx = at_most(above_zero(p.x), s.last_x);
  const float cy = at_most(above_zero(p.y), s.last_y);
  const auto ix = static_cast<std::int32_t>(cx);
  const auto iy = static_cast<std::int32_t>(cy);
  const float tx = cx - static_cast<float>(ix);
  const float ty = cy - static_cast<float>(iy);
  const std::int32_t k = iy * s.stride + ix;
  const float south = surface[k] + tx * (surface[k + 1] - surface[k]);
  const float north = surface[k + s.stride] + tx * (surface[k + s.stride + 1] - surface[k + s.stride]);
  above = p.z - (south + ty * (north - south));

  const float ratio = above * s.per_roughness;
  const float log_height = logarithm(ratio > 1.0F ? ratio : 1.0F);
  // Neither is below zero, and lround would not go into vectors: NOLINTBEGIN(bugprone-*)
  const std::int32_t n =
      static_cast<std::int32_t>(cy + 0.5F) * s.stride + static_cast<std::int32_t>(cx + 0.5F);
  const float wind_x = log_height * (uniform ? s.uniform_shear_x : shear[2 * n]);
  const float wind_y = log_height * (uniform ? s.uniform_shear_y : shear[2 * n + 1]);
  // NOLINTEND(bugprone-*)
  const float du = wind_x - p.u, dv = wind_y - p.v;
  const float re = s.reynolds * std::sqrt(du * du + dv * dv + p.w * p.w);
  const float f = s.step * s.drag * (24.0F + re * (0.4F + 6.0F / (1.0F + std::sqrt(re))));
  const float share = 1.0F / (1.0F + f);
  State q;
  q.u = (p.u + f * wind_x) * share;
  q.v = (p.v + f * wind_y) * share;
  q.w = (p.w - s.gravity * s.step) * share;
  const float half = 0.5F * s.step;
  q.x = p.x + half * s.per_cell * (p.u + q.u);
  q.y = p.y + half * s.per_cell * (p.v + q.v);
  q.z = p.z + half * (p.w + q.w);
  q.x += q.x < 0 ? s.period_x : 0.0F;
  q.y += q.y < 0 ? s.period_y : 0.0F;
  q.x -= q.x >= s.wrap_x ? s.period_x : 0.0F;
  q.y -= q.y >= s.wrap_y ? s.period_y : 0.0F;
  return q;
}

AEOLIAN_INLINE void fly_each(std::ptrdiff_t count, const ParcelStep& step, float* __restrict x,
                             float* __restrict y, float* __restrict z, float* __restrict u,
                             float* __restrict v, float* __restrict w, float* __restrict clearance,
                             const float* __restrict surface, const float* __restrict shear, bool uniform) {
  const ParcelStep s = step;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const State p{x[i], y[i], z[i], u[i], v[i], w[i]};
    float above = 0;
    const State q = moved(p, s, surface, shear, uniform, above);
    const bool flies = above > 0;
    clearance[i] = above;
    x[i] = flies ? q.x : p.x;
    y[i] = flies ? q.y : p.y;
    z[i] = flies ? q.z : p.z;
    u[i] = flies ? q.u : p.u;
    v[i] = flies ? q.v : p.v;
    w[i] = flies ? q.w : p.w;
  }
}

AEOLIAN_KERNEL void fly_in_uniform_wind(std::ptrdiff_t count, const ParcelStep& step, float* __restrict x,
                                        float* __restrict y, float* __restrict z, float* __restrict u,
                                        float* __restrict v, float* __restrict w, float* __restrict clearance,
                                        const float* __restrict surface, const float* __restrict shear) {
  fly_each(count, step, x, y, z, u, v, w, clearance, surface, shear, true);
}

AEOLIAN_KERNEL void fly_in_wind_of_cells(std::ptrdiff_t count, const ParcelStep& step, float* __restrict x,
                                         float* __restrict y, float* __restrict z, float* __restrict u,
                                         float* __restrict v, float* __restrict w,
                                         float* __restrict clearance, const float* __restrict surface,
                                         const float* __restrict shear) {
  fly_each(count, step, x, y, z, u, v, w, clearance, surface, shear, false);
}

}  // namespace

void Parcels::add(float px, float py, float pz, float u, float v, float w, std::uint64_t its_name) {
  x.push_back(px);
  y.push_back(py);
  z.push_back(pz);
  vx.push_back(u);
  vy.push_back(v);
  vz.push_back(w);
  clearance.push_back(0);
  name.push_back(its_name);
  hop.push_back(0);
}

void Parcels::remove(std::size_t i) {
  const auto take_last = [i](auto& values) {
    values[i] = values.back();
    values.pop_back();
  };
  for (std::vector<float>* values : {&x, &y, &z, &vx, &vy, &vz, &clearance}) take_last(*values);
  take_last(name);
  take_last(hop);
}

ParcelStep flight_step(const ErodibleBed& bed, const Grain& grain, const Atmosphere& air, double roughness,
                       double step) {
  const GridGeometry& g = bed.geometry();
  ParcelStep s{};
  s.surface = bed.surface();
  s.stride = bed.stride();
  s.per_roughness = static_cast<float>(1 / roughness);
  s.drag = static_cast<float>(0.75 * air.density / grain.density * air.viscosity /
                              (grain.diameter * grain.diameter));
  s.reynolds = static_cast<float>(grain.diameter / air.viscosity);
  s.gravity = static_cast<float>(air.gravity);
  s.step = static_cast<float>(step);
  s.per_cell = static_cast<float>(1 / g.cell());
  const auto nx = static_cast<float>(g.nx());
  const auto ny = static_cast<float>(g.ny());
  s.period_x = bed.periodic() ? nx : 0;
  s.period_y = bed.periodic() ? ny : 0;
  s.wrap_x = bed.periodic() ? nx : std::numeric_limits<float>::infinity();
  s.wrap_y = bed.periodic() ? ny : std::numeric_limits<float>::infinity();
  s.last_x = bed.last_x();
  s.last_y = bed.last_y();
  return s;
}

void fly(Parcels& p, std::size_t begin, std::size_t end, const ParcelStep& step) {
  const auto count = static_cast<std::ptrdiff_t>(end - begin);
  const auto run = step.shear != nullptr ? fly_in_wind_of_cells : fly_in_uniform_wind;
  run(count, step, &p.x[begin], &p.y[begin], &p.z[begin], &p.vx[begin], &p.vy[begin], &p.vz[begin],
      &p.clearance[begin], step.surface, step.shear);
}

}  // namespace aeolian
