#include "aeolian_core/measure/surface_rays.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Narrows [enter, leave] to where low <= start + t step <= high.
void clip(double start, double step, double low, double high, double& enter, double& leave) {
  if (step == 0) {
    if (start < low || start > high) leave = -infinity;
    return;
  }
  const double a = (low - start) / step;
  const double b = (high - start) / step;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

/// The smallest root of a t^2 + b t + c in [0, end], where c > 0; NaN when there is none.
double first_root(double a, double b, double c, double end) {
  const bool falls_through = c + end * (b + end * a) <= 0;
  const bool may_dip = a > 0 && b < 0 && -b < 2 * a * end;
  if (!falls_through && !may_dip) return HeightMap::unknown;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return HeightMap::unknown;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  double root = infinity;
  for (const double candidate : {q / a, c / q})
    if (candidate >= 0 && candidate < root) root = candidate;
  return root <= end || falls_through ? std::min(root, end) : HeightMap::unknown;
}

}  // namespace

/// h = h00 + x s + y t + xy s t, with s and t from 0 to 1 across the patch.
struct SurfaceRays::Patch {
  double h00, x, y, xy;
};

SurfaceRays::SurfaceRays(const GridGeometry& geometry, const HeightMap::Layer& heights)
    : geometry_(geometry), heights_(heights) {
  if (heights.size() != geometry.size())
    throw Error("surface: " + std::to_string(heights.size()) + " heights for " +
                std::to_string(geometry.size()) + " cells");
  for (const float h : heights) {
    if (!std::isfinite(h)) continue;
    lowest_ = std::min(lowest_, static_cast<double>(h));
    highest_ = std::max(highest_, static_cast<double>(h));
  }
}

SurfaceRays::Patch SurfaceRays::patch(int i, int j) const {
  const int i0 = std::max(i, 0);
  const int j0 = std::max(j, 0);
  const int i1 = std::min(i + 1, geometry_.nx() - 1);
  const int j1 = std::min(j + 1, geometry_.ny() - 1);
  const double h00 = static_cast<double>(heights_[geometry_.index(i0, j0)]);
  const double h10 = static_cast<double>(heights_[geometry_.index(i1, j0)]);
  const double h01 = static_cast<double>(heights_[geometry_.index(i0, j1)]);
  const double h11 = static_cast<double>(heights_[geometry_.index(i1, j1)]);
  return {h00, h10 - h00, h01 - h00, h11 - h10 - h01 + h00};
}

std::optional<SurfaceRays::Hit> SurfaceRays::first_hit(const Eigen::Vector3d& start,
                                                       const Eigen::Vector3d& direction) const {
  const double cell = geometry_.cell();
  const double u0 = (start.x() - geometry_.origin_x()) / cell - 0.5;
  const double v0 = (start.y() - geometry_.origin_y()) / cell - 0.5;
  const double du = direction.x() / cell;
  const double dv = direction.y() / cell;
  const double dz = direction.z();
  // A hair of air above and below lets rays start outside a level surface.
  const double margin = 0.01 * cell;
  double t = 0;
  double leave = infinity;
  clip(u0, du, -0.5, geometry_.nx() - 0.5, t, leave);
  clip(v0, dv, -0.5, geometry_.ny() - 0.5, t, leave);
  clip(start.z(), dz, lowest_ - margin, highest_ + margin, t, leave);
  if (!(t < leave) || leave == infinity) return std::nullopt;

  const auto patch_index = [](double at, int count) {
    return std::clamp(static_cast<int>(std::floor(at)), -1, count - 1);
  };
  int i = patch_index(u0 + t * du, geometry_.nx());
  int j = patch_index(v0 + t * dv, geometry_.ny());
  bool above = false;
  while (t < leave && i >= -1 && j >= -1 && i < geometry_.nx() && j < geometry_.ny()) {
    const double to_next_i = du == 0 ? infinity : ((du > 0 ? i + 1 : i) - u0) / du;
    const double to_next_j = dv == 0 ? infinity : ((dv > 0 ? j + 1 : j) - v0) / dv;
    const double next = std::max(t, std::min({to_next_i, to_next_j, leave}));

    const Patch p = patch(i, j);
    const double s0 = u0 + t * du - i;
    const double t0 = v0 + t * dv - j;
    const double c = start.z() + t * dz - (p.h00 + p.x * s0 + p.y * t0 + p.xy * s0 * t0);
    if (std::isnan(c)) return std::nullopt;
    if (c <= 0 && !above) return std::nullopt;
    above = true;
    const double b = dz - p.x * du - p.y * dv - p.xy * (s0 * dv + t0 * du);
    // Rounding may leave the ray a trifle below the surface at a patch's rim: that is a hit there.
    const double root = c <= 0 ? 0 : first_root(-p.xy * du * dv, b, c, next - t);
    if (!std::isnan(root)) {
      const double s = s0 + root * du;
      const double r = t0 + root * dv;
      return Hit{t + root, (p.x + p.xy * r) / cell, (p.y + p.xy * s) / cell};
    }
    t = next;
    if (to_next_i <= to_next_j)
      i += du > 0 ? 1 : -1;
    else
      j += dv > 0 ? 1 : -1;
  }
  return std::nullopt;
}

}  // namespace aeolian
