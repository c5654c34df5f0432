#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aeolian_core/measure/lower_surface.hpp"
#include "aeolian_core/measure/tile_filter.hpp"

namespace aeolian {

/// What all tiles of a fusion share.
struct FusionRules {
  SurfaceGate gate;
  bool robust = true;
  int patience = 2;
  double first_rate_variance = 0;    ///< of a new cell [m^2/s^2]
  float known_rate_variance = 0;     ///< of a cell that knows something of its rate [m^2/s^2]
  std::uint32_t gathering_time = 0;  ///< for so long a still tile takes its scans together [ms]
  PointScale scale;
};

/// Where a tile writes its estimates: as many rows and columns as lie in the map, `stride` cells apart.
struct TileLayers {
  RowLayers first;
  std::size_t rows, columns, stride;

  RowLayers row(std::size_t y) const {
    const std::size_t at = y * stride;
    return {first.elevation + at, first.variance + at, first.rate + at, first.rate_variance + at};
  }
};

/// Up to 32 x 32 cells of the live height map.
///
/// Points that agree with their cell's prediction go into its sums. All others, and those of unknown cells,
/// are set aside, sorted; their lower surface begins a new cell, or replaces a known one when it persists.
/// Scans that follow each other quickly say the same of a still bed: such a tile gathers their points, moves
/// on and is written once for all of them. Everything is a function of what is known before the scan and of
/// the set of the scan's points, not of their order.
class FusionTile {
 public:
  static constexpr std::size_t side = FilterRow::cells;
  static constexpr std::size_t cell_count = side * side;
  /// A bit for each row of a tile.
  using Rows = std::uint32_t;

  /// The rows in which samples lie.
  static Rows rows_of(const Sample* samples, std::size_t count);
  /// Makes `scan` (at `time` [ms]) the open one, after taking in the one before, and lets `rows` reach it.
  void open(std::uint32_t scan, std::uint32_t time, Rows rows, const FusionRules& rules, HeightSteps& steps,
            const TileLayers& layers);
  /// Adds samples, whose rows are open, to the open scan; how many agree with what is known.
  std::size_t add(const Sample* samples, std::size_t count, const FusionRules& rules);
  struct Result {
    bool written = false;           ///< estimates with the points of this call
    std::size_t new_cells = 0;      ///< that begin, or begin anew, in the open scan
    std::size_t outlier_cells = 0;  ///< whose points were refused
    std::size_t outliers = 0;       ///< points of these cells that were refused
  };
  /// Writes the estimates of the cells with points in the open scan that lie in `rows`, or, of a tile that
  /// gathers, of those with points that were set aside.
  Result publish(Rows rows, const FusionRules& rules, const TileLayers& layers);

  /// Begins a cell from a known map at the tile's time; the open scan has no points in the tile yet.
  void begin_cell(std::size_t cell, const CellEstimate& known);
  /// Makes a cell unknown; likewise.
  void forget_cell(std::size_t cell);
  /// Moves on to the time `end`, which then is zero: the clock jumped back.
  void restart_clock(std::uint32_t end, const FusionRules& rules, HeightSteps& steps);
  /// Writes the number of points on which each known cell rests, the open scan included; rows `stride` apart.
  void write_counts(const FusionRules& rules, float* counts, std::size_t stride) const;

 private:
  enum class Verdict { agrees, refused, begins };

  FilterRow& row(std::size_t cell) { return rows_[cell / side]; }
  const FilterRow& row(std::size_t cell) const { return rows_[cell / side]; }
  bool gathers_on(std::uint32_t time, const FusionRules& rules) const;
  void close(std::uint32_t time, Rows rows, const FusionRules& rules, HeightSteps& steps,
             const TileLayers& layers);
  void open_rows(Rows rows, HeightSteps& steps);
  bool known(std::size_t cell) const { return row(cell).height_variance[cell % side] > 0; }
  void judge_motion(const TileMotion& motion);
  void take_set_aside(const FusionRules& rules);
  void forget_refusals();
  void sort_set_aside();
  int refusals_in_row(std::size_t cell, const SurfaceSum& sum, const FusionRules& rules) const;
  Verdict judge(std::size_t cell, const SurfaceSum& sum, const FusionRules& rules) const;

  std::array<FilterRow, side> rows_;
  std::array<std::uint32_t, side> row_time_{};       ///< that a row's prediction has reached [ms]
  Rows open_ = 0;                                    ///< rows with points in the open scan
  std::array<std::int32_t, cell_count> rival_{};     ///< where refused points lay [steps]
  std::array<std::uint8_t, cell_count> refusals_{};  ///< scans in a row whose points disagreed alike
  bool any_refusals_ = false;
  std::vector<Sample> set_aside_;
  std::size_t sorted_ = 0;             ///< of those set aside, how many lie in order
  std::uint32_t scan_ = 0;             ///< 0: none
  std::uint32_t time_ = 0;             ///< of the open scan [ms]
  std::uint32_t gathering_since_ = 0;  ///< [ms]
  bool gathers_ = false;               ///< the open scan has been added to the one before
  bool still_ = false;
  std::uint32_t still_since_ = 0;  ///< [ms]
};

}  // namespace aeolian
