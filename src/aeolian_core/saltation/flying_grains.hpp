#pragma once

#include <vector>

#include "aeolian_core/saltation/flight.hpp"

namespace aeolian {

/// Grains of one size or of several that fly in one wind. Of several, classes of launches are those of the
/// first size, then as many of the next.
class FlyingGrains {
 public:
  explicit FlyingGrains(const Drag& drag) : FlyingGrains({drag}, {1}, 1) {}
  /// `mass` of each size over that of the grain that stresses are counted in; `rarest`: the least part of all
  /// grains that one size is, about.
  FlyingGrains(std::vector<Drag> drag, std::vector<double> mass, double rarest);

  /// See aeolian::fly, with the stresses of all sizes together.
  void fly(const Launches& launches, const WindProfile& wind, double acceleration, double tolerance,
           Landings& landings, std::vector<double>& stress) const;
  /// Classes below this part of all grains are not flown.
  double negligible() const { return negligible_; }

 private:
  std::vector<Drag> drag_;
  std::vector<double> mass_;
  double negligible_;
};

/// One of `sizes` equal parts of all classes.
/// @{
Launches part_of(const Launches& all, std::size_t size, std::size_t sizes);
Landings part_of(const Landings& all, std::size_t size, std::size_t sizes);
/// @}

}  // namespace aeolian
