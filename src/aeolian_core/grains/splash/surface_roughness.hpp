#pragma once

#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// How rough a patch of bed is at the scale of its grains: brinks per diameter along the flight, a state that
/// impacts change (Werner 1987, ch. III; splash specification, secs. 3.6 and 6.5). Impact::roughness takes
/// it.
///
/// On average over the patch: a target that leaves makes a hole, which has a brink and an anti-brink; a grain
/// that leaves beside a step takes one away; a grain that comes to rest fills a hole where it falls into one,
/// whose chance is their density. At most every second grain stands at a brink.
class SurfaceRoughness {
 public:
  static constexpr double most = 0.5;  ///< brinks per diameter

  /// `length` of the patch along the flight, in grain diameters. Throws Error for one that is not positive
  /// and for brinks that are not 0 to 0.5 per diameter.
  explicit SurfaceRoughness(double length, double brinks = 0);

  double brinks() const { return brinks_; }  ///< per diameter

  void ejected(const SplashEvent& event);
  void came_to_rest(double grains);  ///< so many, on average over the patch

 private:
  void add(double steps);

  double length_, brinks_;
};

}  // namespace aeolian
