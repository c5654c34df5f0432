#pragma once

#include <vector>

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"
#include "aeolian_core/bedforms/erosion/hop_table.hpp"
#include "aeolian_core/wind/wind_model.hpp"

namespace aeolian {

/// One wind over a bed and what it can carry: the friction velocity of each cell, flights, how many parcels
/// leave, how far they go.
///
/// A parcel goes `reach` from where it leaves to where it stays; so many leave an evenly exposed flat bed
/// that they carry the saturated flux: launches per area and time = Q / (rho_bed reach volume).
class Drift {
 public:
  /// Throws Error for a wind that is not physical or whose map is not that of the bed.
  Drift(const WindField& wind, const ErodibleBed& bed, const Grain& grain,
        const ErosionParameters& parameters);

  double roughness() const { return roughness_; }  ///< z0 [m]
  double threshold() const { return threshold_; }  ///< u*_t of what bonds least, on the flat [m/s]
  double strongest() const { return strongest_; }  ///< u* anywhere [m/s]
  bool blows() const { return strongest_ > threshold_; }
  bool uniform() const { return cells_.empty(); }

  /// u* and the wind's direction, east and north, at a cell.
  struct Cell {
    float friction_velocity, east, north;
  };
  const Cell& at(std::size_t cell) const { return uniform() ? everywhere_ : cells_[cell]; }
  /// Friction velocity over von Karman's constant at each place of the bed's surface; null when uniform.
  const float* shear() const { return shear_.empty() ? nullptr : shear_.data(); }

  /// Saturated flux of volume per width [m^2/s], with the pores of the bed.
  double flux(double friction_velocity) const;
  double mean_flux() const { return mean_flux_; }  ///< over the cells
  /// Parcels that leave a flat cell [1/s].
  double launches(double friction_velocity) const;
  double most_launches() const { return most_launches_; }
  double reach(double friction_velocity) const;  ///< [m]
  const HopTable& hops(double friction_velocity) const;

 private:
  std::size_t level(double friction_velocity) const;
  double mean_reach(const HopTable& table) const;

  const ErosionParameters parameters_;
  Grain grain_;
  double parcel_, cell_area_;
  double roughness_ = 0, threshold_ = 0, strongest_ = 0, most_launches_ = 0, mean_flux_ = 0;
  Cell everywhere_{};
  std::vector<Cell> cells_;
  std::vector<float> shear_;
  double level_step_ = 0;         ///< of the friction velocity between tables [m/s]
  std::vector<HopTable> tables_;  ///< from the threshold to the strongest
  std::vector<double> reach_;
};

}  // namespace aeolian
