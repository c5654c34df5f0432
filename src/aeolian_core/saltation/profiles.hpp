#pragma once

#include <vector>

#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// What flies at which height: means over layers of equal thickness, from the bed upwards.
struct SaltationProfiles {
  double thickness = 0;                  ///< of a layer [m]
  std::vector<double> height;            ///< of the middle of a layer over the bed [m]
  std::vector<double> number_density;    ///< [m^-3]
  std::vector<double> number_flux;       ///< n v_x [m^-2 s^-1]
  std::vector<double> cubed_flux;        ///< n v_x^3, which Werner's table 4.4 calls kinetic energy [s^-3]
  std::vector<double> kinetic_flux;      ///< m n v_x |v|^2 / 2 [W m^-2]
  std::vector<double> drag;              ///< of the grains on the air, against the wind [N m^-3]
  std::vector<double> wind;              ///< [m/s]
  std::vector<double> undisturbed_wind;  ///< the same free wind without grains [m/s]

  double mass_flux(double grain_mass) const;  ///< over all heights [kg m^-1 s^-1]
  double stress() const;                      ///< that the grains take from the wind [Pa]
  /// Height of the largest value of a column, over this thickness of layers taken together [m].
  double peak(const std::vector<double>& column, double layer) const;
  /// Half of a column's sum lies below [m].
  double median_height(const std::vector<double>& column) const;
};

/// Flies the grains of a state once more and adds up how long they stay in each layer and what they do there.
/// Throws Error for a thickness that is not positive or takes more than a million layers.
SaltationProfiles profiles(const SteadyState& state, const SaltatingBed& bed, double thickness = 2e-4);

}  // namespace aeolian
