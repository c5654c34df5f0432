#pragma once

#include "aeolian_core/wind/air_grid.hpp"
#include "aeolian_core/wind/spectral_wind.hpp"
#include "aeolian_core/wind/terrain_response.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian {

/// The wind nearest to a first guess, the upwind profile over the ground below, that neither gains nor loses
/// air and does not blow through the ground (Sherman 1978, J. Appl. Meteor. 17, 312), for steep relief.
///
/// Minimises alpha_1^2 |u - u0|^2 + alpha_2^2 (w - w0)^2. With a uniform guess and alpha_1 = alpha_2 it is
/// potential flow. Boxes cut by the ground have as much of each face as is open, so cliffs and steps are met
/// as they are. It knows no friction: the wind at the ground is fastest at the crest and not upwind of it.
class MassConsistentVolume : public WindVolume {
 public:
  struct Settings {
    std::size_t max_boxes = 400000;
    double vertical_ease = 1;  ///< (alpha_1/alpha_2)^2; below one the air rises less easily than it turns
  };
  MassConsistentVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
                       const Settings& settings);

  AirVelocity velocity(double x, double y, double height) const override;
  double top() const override { return top_; }
  const FaceFlows& flows() const override { return flows_; }
  const AirGrid& grid() const { return grid_; }
  /// Height over the ground of the wind that tells its stress [m].
  double reference_height() const { return reference_; }
  int iterations() const { return iterations_; }

 private:
  void guess(double direction);
  void correct(const Settings& settings);
  /// At a height over the ground [m] that the boxes resolve.
  AirVelocity resolved(double x, double y, double height) const;

  WindRelief relief_;
  UpwindProfile upwind_;
  AirGrid grid_;
  FaceFlows open_;      ///< open areas [m^2]
  FaceFlows upstream_;  ///< mean speed of the upwind profile in upright faces
  FaceFlows flows_;
  double reference_ = 0;
  double top_ = 0;
  int iterations_ = 0;
};

/// The stress of that wind by the law of the wall, and separated air behind steep lees as LeeBubble tells it.
TerrainResponse mass_consistent_response(const HeightMap& surface, double direction,
                                         const ReliefSettings& settings,
                                         const MassConsistentVolume::Settings& solver);

}  // namespace aeolian
