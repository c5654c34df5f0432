#pragma once

#include <vector>

#include "aeolian_core/bedforms/wind_frame.hpp"

namespace aeolian {

/// Where the impact rain sets grains reptating and where they come down, on a bed given in a wind frame.
///
/// Erosion follows exposure; hops are exponentially distributed on a flat bed and end early where the bed has
/// risen since take-off, late where it has fallen, by `shortening` times the rise: 1 / tangent of the angle
/// at which grains come down. To first order in the rise, so that it is a flux, -shortening (h F - G), where
/// F is the flux of grains through a height h and G the same flux with each grain times its height of
/// take-off. Everything is relative to a flat bed: erosion and deposition are 1 there. What leaves a line is
/// in `outflow`, what enters in `inflow`, in flat-bed cells: the sums over all cells obey deposition -
/// erosion = inflow - outflow to rounding.
class ImpactSweep {
 public:
  /// `hop` is the mean reptation length [m].
  ImpactSweep(const WindFrame& frame, double tan_impact_angle, double hop, double shortening);

  /// `height` [m] above the dune-scale surface, indexed as the frame says.
  void run(const std::vector<double>& height);

  const std::vector<double>& erosion() const { return erosion_; }
  /// May fall below zero where the bed is so steep that hops change much over a cell.
  const std::vector<double>& deposition() const { return deposition_; }
  double inflow() const { return inflow_; }
  double outflow() const { return outflow_; }

 private:
  struct Stretch {
    std::size_t begin, end;  ///< stations at which a line is on the grid
  };
  struct Flux {
    double grains;   ///< F, in flat-bed erosions of one cell
    double heights;  ///< G, the same times the heights of take-off [m]
  };
  Stretch stretch_of(int line) const;
  int wrapped(int row) const;
  void gather(const std::vector<double>& height, int line, Stretch stretch);
  void scatter(int line, Stretch stretch);
  void erode(Stretch stretch, double envelope);
  Flux hop_along(Stretch stretch, Flux flux, double before, double after);
  double shift(Flux flux, double height) const;
  void run_periodic(const std::vector<double>& height);
  void run_open(const std::vector<double>& height);

  const WindFrame& frame_;
  double drop_;        ///< height lost by a falling grain from station to station [m]
  double carried_;     ///< share of the reptation flux that passes a station
  double launched_;    ///< share of a cell's ejected grains that leave the cell
  double shortening_;  ///< shift of flux per metre of rise [1/m]
  std::vector<double> line_height_, line_exposure_, line_erosion_, line_deposition_;
  std::vector<double> envelope_, first_height_, last_height_;  ///< of each periodic line
  std::vector<Flux> sent_, received_;
  std::vector<double> erosion_, deposition_;
  double inflow_ = 0;
  double outflow_ = 0;
};

}  // namespace aeolian
