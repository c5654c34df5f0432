#pragma once

#include <vector>

#include "aeolian_core/bedforms/wind_frame.hpp"

namespace aeolian {

/// Where the impact rain sets grains reptating and where they come down, on a bed given in a wind frame.
///
/// Erosion follows exposure; hops are exponentially distributed. Everything is relative to a flat bed:
/// erosion and deposition are 1 there. What leaves a line is in `outflow`, what enters in `inflow`, in
/// flat-bed cells: the sums over all cells obey deposition - erosion = inflow - outflow to rounding.
class ImpactSweep {
 public:
  /// `hop` is the mean reptation length [m].
  ImpactSweep(const WindFrame& frame, double tan_impact_angle, double hop);

  /// `height` [m] above the dune-scale surface, indexed as the frame says.
  void run(const std::vector<double>& height);

  const std::vector<double>& erosion() const { return erosion_; }
  const std::vector<double>& deposition() const { return deposition_; }
  double inflow() const { return inflow_; }
  double outflow() const { return outflow_; }

 private:
  struct Stretch {
    std::size_t begin, end;  ///< stations at which a line is on the grid
  };
  Stretch stretch_of(int line) const;
  int wrapped(int row) const;
  void gather(const std::vector<double>& height, int line, Stretch stretch);
  void scatter(int line, Stretch stretch);
  void erode(Stretch stretch, double envelope);
  double hop_along(Stretch stretch, double flux);
  void run_periodic(const std::vector<double>& height);
  void run_open(const std::vector<double>& height);

  const WindFrame& frame_;
  double drop_;      ///< height lost by a falling grain from station to station [m]
  double carried_;   ///< share of the reptation flux that passes a station
  double launched_;  ///< share of a cell's ejected grains that leave the cell
  std::vector<double> line_height_, line_exposure_, line_erosion_, line_deposition_;
  std::vector<double> envelope_, first_height_, sent_, received_;  ///< of each periodic line
  std::vector<double> erosion_, deposition_;
  double inflow_ = 0;
  double outflow_ = 0;
};

}  // namespace aeolian
