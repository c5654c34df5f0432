#pragma once

#include <array>
#include <vector>

#include "aeolian_core/bedforms/height_map/wind_frame.hpp"
#include "aeolian_core/bedforms/sorting/sorted_hop_stage.hpp"

namespace aeolian {

/// ImpactSweep for grains of two sizes on soft ground: which parts of the bed the rain strikes and where the
/// grains of each size come down within a step. The composition of the surface is that at the beginning of
/// the step. All is relative to a flat bed of fine grains.
class SortedSweep {
 public:
  static constexpr int sizes = SortedHopStage::sizes;
  using Fields = std::array<FrameField, sizes>;

  /// `law`: of the fine and the coarse grains; `supply`: share of a flat bed's flux that comes in over open
  /// borders.
  SortedSweep(const WindFrame& frame, const std::array<SizeLaw, sizes>& law, double supply);

  /// Sweeps a bed over a step in which a flat bed of fine grains loses `depth` [m]. Heights [m] and coarse
  /// fractions with pads filled; impacts see the height above `dune`. Of each size no more than `layer` [m]
  /// times its fraction is set moving.
  void run(const FrameField& bed, const FrameField& dune, const FrameField& fraction, double depth,
           double layer);

  const std::array<SizeLaw, sizes>& law() const { return law_; }
  /// Means over the step for line q at a station, as in ImpactSweep: the exposure at which each size is
  /// struck, and what comes down of it.
  const Fields& struck() const { return struck_; }
  const Fields& deposition() const { return deposition_; }
  /// Flux of a size that lines bring in and take out at open borders, in flat-bed cells.
  double inflow(int size) const { return inflow_[static_cast<std::size_t>(size)]; }
  double outflow(int size) const { return outflow_[static_cast<std::size_t>(size)]; }

 private:
  struct Task {
    const FrameField& bed;
    const FrameField& dune;
    const FrameField& fraction;
    double depth;
  };
  struct Balance {
    std::array<double, sizes> inflow{}, outflow{};
  };
  class Bundle;

  void close_period();

  const WindFrame& frame_;
  std::array<SizeLaw, sizes> law_;
  double supply_;
  Fields struck_, deposition_;
  std::array<std::vector<double>, sizes> seam_in_, seam_out_;
  std::array<double, sizes> inflow_{}, outflow_{};
};

/// The law of one size on the lines of a frame; `shortening` as in RippleParameters.
SizeLaw size_law(const WindFrame& frame, const ImpactAngles& angles, double hop, double shortening,
                 double mobility, bool coarse);

}  // namespace aeolian
