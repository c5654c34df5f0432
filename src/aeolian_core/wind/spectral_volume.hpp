#pragma once

#include <optional>

#include "aeolian_core/wind/spectral_wind.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian {

/// The wind of linear theory in the air over a map: layers that follow the ground (or the tops of bubbles),
/// thin below, thick above. Along a streamline the pressure of potential flow over the relief, taken at the
/// speed of the middle layer, speeds the air up or slows it down; continuity gives what rises or sinks, so
/// that no box of the grid gains or loses air.
class SpectralVolume : public WindVolume {
 public:
  /// Up to `top` over the ground [m], positive. `upwind` uniform gives potential flow.
  SpectralVolume(const WindRelief& relief, double direction, const UpwindProfile& upwind,
                 const LeeBubble& bubble, double top);

  AirVelocity velocity(double x, double y, double height) const override;
  double top() const override { return faces_.back(); }
  const FaceFlows& flows() const override { return flows_; }
  /// Heights of the layers' borders over the ground [m].
  const std::vector<double>& faces() const { return faces_; }

 private:
  void blow(const ReliefSpectrum& spectrum);
  void raise();
  /// Eastward and northward velocity in one layer at a place in cells.
  AirVelocity level(double x, double y, int iz) const;

  GridGeometry geometry_;
  UpwindProfile upwind_;
  double direction_;
  WindRelief relief_;           ///< with bubbles
  std::vector<double> raised_;  ///< by bubbles [m]; empty without any
  std::vector<double> faces_;
  std::vector<double> centres_;  ///< where the upwind profile has its mean over the layer [m]
  FaceFlows flows_;
};

}  // namespace aeolian
