#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace aeolian {

/// Chooses how large the surface's quads may be on the screen, so that a frame takes no longer than its
/// budget: larger under load, small again when there is room. A frame is taken to cost a constant and so much
/// for each triangle; what finer quads would cost is reckoned before they are tried, so that it does not
/// swing. A quarter of the budget is the surface's however long the rest takes.
class FrameBudget {
 public:
  /// `seconds` for a frame, > 0.
  explicit FrameBudget(double seconds) : budget_(seconds) {}

  /// How many triangles quads of a size [pixels] make in the present view.
  using Triangles = std::function<std::size_t(double quad_pixels)>;
  /// Tells what the last frame took [s].
  void add_frame(double seconds, const Triangles& triangles);

  double quad_pixels() const { return size(step_); }
  /// The median of the latest frames [s], 0 before there are any.
  double frame_seconds() const { return median_; }

 private:
  static double size(int step);

  double budget_;
  int step_ = 0;
  std::vector<double> frames_;  ///< since the last decision [s]
  double median_ = 0;           ///< [s]
  double triangle_seconds_ =
      std::numeric_limits<double>::infinity();  ///< cost of one triangle, not known yet
  std::size_t last_triangles_ = 0;              ///< at the last decision
};

}  // namespace aeolian
