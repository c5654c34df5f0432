#pragma once

#include <vector>

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"

namespace aeolian {

/// Time to full bonds at a temperature [s]: t_b at the reference temperature and below it, shorter by
/// Arrhenius' law above (specification sec. 3.5).
double bonding_time(const SnowBonding& snow);
/// Degree of bonding of snow that was not moved for `age` [s], 0 to 1.
double bond_degree(const SnowBonding& snow, double age);
/// gamma of such snow over that of sand.
double bond_cohesion(const SnowBonding& snow, double degree);
/// Density of ice, 0.2 mm, repose 38 degrees, the bulk density of drifted snow.
Grain drifting_snow();

/// How old the snow of each cell is, since it was last set down, and what follows from that. Ages are of the
/// skin of the loose layer, weighted with mass: what comes down makes it younger.
class SnowCover {
 public:
  SnowCover(const SnowBonding& snow, const ErodibleBed& bed);

  double age(std::size_t cell) const { return now_ - born_[cell]; }  ///< [s]
  void set_age(std::size_t cell, double age) { born_[cell] = now_ - age; }
  /// Loose snow has come down.
  void deposited(std::size_t cell, std::int32_t units);
  /// gamma of the surface over that of sand.
  double cohesion(std::size_t cell) const { return bond_cohesion(snow_, bond_degree(snow_, age(cell))); }

  /// Lets snow age, fall and sinter for `duration` [s]. At the melting point all of it turns to ground, for
  /// good. Returns the volume fallen, in units.
  std::int64_t advance(ErodibleBed& bed, double duration, double bulk_density);

 private:
  SnowBonding snow_;
  double skin_;  ///< [units]
  double now_ = 0;
  double owed_ = 0;  ///< snow fallen, less than a unit [units]
  std::vector<double> born_;
};

}  // namespace aeolian
