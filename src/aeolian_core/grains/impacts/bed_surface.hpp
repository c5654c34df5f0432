#pragma once

#include <vector>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// The surface of a bed as a grain of the bed's own size meets it from above.
///
/// In two dimensions it is one chain: the grains of the upper envelope, in the direction of flight (x). A
/// fall of `step_diameters` or more from one grain of the chain to the next is a brink, a rise an anti-brink
/// (Werner 1987, ch. III). In three dimensions the same is done on vertical sections along the flight, a
/// quarter of a diameter apart.
class BedSurface {
 public:
  /// The steps of a hexagonal bed have 0.87 diameters, those between terraces of looser beds less; grains
  /// that merely lie uneven differ by less than half of one.
  static constexpr double step_diameters = 0.5;

  /// For grains of this mean radius [m] between x = 0 and `length` [m]; `width` is that across the flight, of
  /// use in three dimensions only. Throws Error for a bed without grains.
  template <int Dim>
  BedSurface(const GrainDynamics<Dim>& grains, double radius, double length, double width);

  /// Of a grain, by its number: 1 for those of the surface, 2 for those that were the surface without the
  /// first layer, 3 for all below.
  int layer(int grain) const { return layers_[static_cast<std::size_t>(grain)]; }
  /// Brink for the two grains on the upstream side of a brink, anti_brink for the two on the downstream side
  /// of an anti-brink, other for the rest.
  Origin step(int grain) const { return steps_[static_cast<std::size_t>(grain)]; }
  /// Brinks per diameter of the bed's grains, along the flight.
  double roughness() const { return roughness_; }
  double mean_height() const { return mean_height_; }  ///< of the centres of the surface's grains [m]
  double top() const { return top_; }                  ///< of the highest grain [m]

 private:
  std::vector<int> layers_;
  std::vector<Origin> steps_;
  double roughness_ = 0;
  double mean_height_ = 0;
  double top_ = 0;
};

extern template BedSurface::BedSurface(const GrainDynamics<2>&, double, double, double);
extern template BedSurface::BedSurface(const GrainDynamics<3>&, double, double, double);

}  // namespace aeolian
