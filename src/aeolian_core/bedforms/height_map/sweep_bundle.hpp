#pragma once

#include <functional>
#include <vector>

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"
#include "aeolian_core/bedforms/height_map/hop_stage.hpp"
#include "aeolian_core/bedforms/height_map/wind_frame.hpp"

namespace aeolian {

/// What an ImpactSweep has its bundles of lines do.
struct SweepTask {
  /// Share of a flat bed's flux that comes in over an open border at a station, between rows q - 1 and q.
  using Supply = std::function<double(int station, int q)>;

  const WindFrame& frame;
  const HopLaw& law;
  const FrameField& bed;
  const FrameField& dune;
  const HardGround* ground;    ///< null when there is none
  const ActivePatches* sandy;  ///< where something can be eroded, on hard ground
  double depth;                ///< that a flat bed loses [m]
  int first;                   ///< station where lines begin: before the grid on a periodic one
  int shade;  ///< stations that the longest shadow may cover; all where sand comes over unknown cells

  const Supply& supply;  ///< empty: 1 everywhere

  FrameField& erosion;  ///< results, see ImpactSweep
  FrameField& deposition;
  std::vector<double>& seam_in;  ///< flux of each line through the seam of a periodic grid
  std::vector<double>& seam_out;
};

/// What a bundle brought in and took out, and the rows that it wrote, on hard ground.
struct SweptBundle {
  struct Rows {
    int station, begin, end;
  };
  double inflow = 0;
  double outflow = 0;
  std::vector<Rows> touched;
};

/// Sweeps the lines begin <= j < end, at most HopStage::most_lines, side by side from the first station to
/// the last. On hard ground nothing is done where no sand lies that can be eroded, or all of it in the
/// shadow, and no grain is on its way: a flux of less than `least_flux` of a flat bed's is put down.
SweptBundle sweep_bundle(const SweepTask& task, int begin, int end);

/// Share of a flat bed's flux.
constexpr double least_flux = 1e-4;

/// Stations that the last of the stages is behind the first, and its result behind what it reads.
constexpr int stage_stations = 6;

}  // namespace aeolian
