#include "aeolian_rviz/frame_budget.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

/// Of frames, so that one that the system delayed does not count.
constexpr std::size_t frames_of_a_decision = 7;
constexpr double finest_quad_pixels = 3;
constexpr int coarsest_step = 8;  // 48 pixels
/// Finer quads are tried only when they are reckoned to stay this far below what is allowed.
constexpr double room = 0.8;
/// [s]. A software renderer's cost some 0.6e-6 s: more is another's load that came at the wrong moment.
constexpr double dearest_triangle = 1e-6;
/// [s]. Reckoned where the frame takes too long: a lighter load at the right moment makes triangles seem
/// free.
constexpr double cheapest_triangle = 1e-7;

}  // namespace

double FrameBudget::size(int step) { return finest_quad_pixels * std::pow(2, step / 2.0); }

void FrameBudget::add_frame(double seconds, const Triangles& triangles) {
  frames_.push_back(seconds);
  if (frames_.size() < frames_of_a_decision) return;
  const double before = median_;
  median_ = median(frames_);
  frames_.clear();

  const std::size_t now = triangles(quad_pixels());
  const auto count = static_cast<double>(std::max<std::size_t>(now, 1));
  const auto last = static_cast<double>(last_triangles_);
  // At most the whole frame; less once two counts have told the constant from the triangles.
  const double most = median_ / count;
  if (last > 0 && std::abs(count - last) > 0.3 * last)
    triangle_seconds_ = std::max((median_ - before) / (count - last), 0.0);
  triangle_seconds_ = std::min({triangle_seconds_, most, dearest_triangle});
  if (median_ > budget_) triangle_seconds_ = std::max(triangle_seconds_, cheapest_triangle);
  last_triangles_ = now;

  // Where others take the budget, drawing badly would not save the frame.
  const double others = median_ - triangle_seconds_ * count;
  const double allowed = std::max(budget_ - others, budget_ / 4);
  const auto cost = [&](int step) { return triangle_seconds_ * static_cast<double>(triangles(size(step))); };
  while (step_ < coarsest_step && cost(step_) > allowed) ++step_;
  for (int finer = 0; finer < step_; ++finer)
    if (cost(finer) <= room * allowed) step_ = finer;
}

}  // namespace aeolian
