#pragma once

namespace aeolian {

/// The two ways in which an impact sets the bed moving on a stoss (Werner 1987, sec. V): the grain that is
/// struck, or the last grain of the row that is struck.
enum class EjectionLaw { target, brink };

/// A ripple as a triangle (Werner 1987, sec. V, collision model): a stoss at an angle, and a lee line at the
/// impact angle, which is the edge of the shadow, not the sand. All triangles of one bed have both angles in
/// common, so a height tells a ripple.
class TriangularRipple {
 public:
  /// Angles [rad] of both sides. Throws Error when one is not between 0 and 90 degrees.
  TriangularRipple(double stoss_angle, double impact_angle);

  /// Wavelength / height: cot(stoss) + cot(impact angle).
  double index() const;
  double wavelength(double height) const { return index() * height; }       ///< [m]
  double stoss_length(double height) const { return height / tan_stoss_; }  ///< horizontal [m]

  /// Speed [m/s] under `impact_rate` impacts per length of stoss and time in a slice one grain thick [1/(m
  /// s)], each of which moves one grain of effective diameter d [m] over the reptation length [m]: target, v
  /// = F d^2 D / (L1 tan(stoss)) (eq. 5.9); brink, v = 2 F d^3 D cos(stoss) / (L1^2 tan(stoss)) (eq. 5.10).
  /// Slower in proportion to size, and to its square.
  double speed(EjectionLaw ejection, double height, double impact_rate, double diameter,
               double reptation_length) const;

 private:
  double tan_stoss_;
  double tan_impact_;
};

}  // namespace aeolian
