#pragma once

#include <cstddef>
#include <vector>

#include "aeolian_core/saltation/octave_table.hpp"

namespace aeolian {

/// Mean wind over a flat bed, from the roughness length upwards, slowed by the grains in it: the first
/// integral of Prandtl's mixing length (Werner 1987, eq. 4.27),
///
///     u(y) = 1/kappa Int u*_loc dln y,   rho u*_loc^2 = rho u*^2 - (stress that the grains carry at y).
///
/// The stress is known at levels, eight in each factor of two of the height; between them u*_loc is
/// linear in ln y. Where grains carry more stress than there is, the wind falls with height.
class WindProfile {
 public:
  static constexpr int levels_per_octave = 8;
  static constexpr int octaves = 26;
  static constexpr std::size_t levels = std::size_t{levels_per_octave} * octaves + 1;

  /// `roughness` [m], where the wind is zero; positive.
  explicit WindProfile(double roughness);

  /// Without grains.
  void set_logarithmic(double friction_velocity);
  /// With grains that carry rho (friction_velocity^2 - surface^2) share[i] at level i; share[0] = 1.
  void set(double friction_velocity, double surface_friction_velocity, const std::vector<double>& share);

  double roughness() const { return roughness_; }
  double height(std::size_t level) const { return height_[level]; }  ///< [m]
  const double* heights() const { return height_.data(); }           ///< of all levels [m]
  /// The highest level that is not above a height.
  std::size_t level_below(double height) const {
    if (!(height > roughness_)) return 0;
    const std::size_t level = octave_piece<3>(std::min(std::max(height * inverse_roughness_, 1.0), top));
    // Rounding may put a height onto the wrong side of a level.
    if (height_[level] > height) return level - 1;
    return level + 1 < levels && height_[level + 1] <= height ? level + 1 : level;
  }
  /// Wind at a height, up to roughness x 2^26; zero below the roughness [m/s].
  double speed(double height) const;
  double speed_at_level(std::size_t level) const { return speed_[level]; }  ///< [m/s]
  /// Shear velocity at a level [m/s]; negative where the wind falls with height.
  double shear_velocity(std::size_t level) const { return shear_[level]; }
  /// The roughness that the wind above the grains seems to have [m].
  double apparent_roughness() const;

  using Table = OctaveTable<5>;
  /// Speed against height / roughness, from one to below 2^26.
  Table::View view() const { return table_.view(); }
  static constexpr double top = 0x1p26 - 1;  ///< of the table, in roughnesses

 private:
  double roughness_;
  double inverse_roughness_;
  std::vector<double> height_;
  std::vector<double> log_step_;  ///< between neighbouring knots of the table
  std::vector<double> log_part_;  ///< how far a knot is between its levels, in ln y
  std::vector<double> speed_;
  std::vector<double> shear_;
  Table table_;
};

}  // namespace aeolian
