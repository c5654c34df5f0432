#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aeolian_core/measure/lower_surface.hpp"
#include "aeolian_core/measure/tile_filter.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// What all tiles of a fusion share.
struct FusionRules {
  SurfaceGate gate;
  bool robust = true;
  int patience = 2;
  double first_rate_variance = 0;    ///< of a new cell [m^2/s^2]
  std::uint32_t gathering_time = 0;  ///< for so long a still tile takes its scans together [ms]
  PointScale scale;
};

/// A set of cells of a tile.
class CellSet {
 public:
  static constexpr std::size_t side = TileMask::tile_cells;
  using Row = std::uint32_t;  ///< a bit for each column

  bool has(std::size_t cell) const { return (rows_[cell / side] >> (cell % side) & 1U) != 0; }
  void add(std::size_t cell) { rows_[cell / side] |= Row{1} << (cell % side); }
  void add(const CellSet& other) {
    for (std::size_t y = 0; y < side; ++y) rows_[y] |= other.rows_[y];
  }
  void remove(std::size_t cell) { rows_[cell / side] &= ~(Row{1} << (cell % side)); }
  void clear() { rows_.fill(0); }
  void fill() { rows_.fill(~Row{0}); }
  Row& row(std::size_t y) { return rows_[y]; }
  Row row(std::size_t y) const { return rows_[y]; }
  bool empty() const {
    Row any = 0;
    for (const Row row : rows_) any |= row;
    return any == 0;
  }

 private:
  std::array<Row, side> rows_{};
};

/// Where a tile writes its estimates: as many rows and columns as lie in the map, `stride` cells apart.
struct TileLayers {
  float *elevation, *variance, *rate, *rate_variance;  ///< of the first cell
  std::size_t rows, width, stride;

  CellSet::Row columns() const {
    return width == CellSet::side ? ~CellSet::Row{0} : (CellSet::Row{1} << width) - 1;
  }
};

/// The cells of a set in a row.
struct CellList {
  std::array<std::uint16_t, CellSet::side * CellSet::side> cells;
  std::size_t count = 0;

  /// Adds those of a set's row `y`.
  void add(std::size_t y, CellSet::Row row) {
    for (; row != 0; row &= row - 1)
      cells[count++] =
          static_cast<std::uint16_t>(y * CellSet::side + static_cast<std::size_t>(__builtin_ctz(row)));
  }
};

struct MarkedCells {
  CellSet set;
  CellList list;
};

/// Marks the cells in which samples lie, quickly.
class CellMarks {
 public:
  void add(const Sample* samples, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) marks_[samples[i].cell()] = 1;
  }
  /// The marked cells, which are unmarked.
  void take(MarkedCells& marked);

 private:
  CellSet::Row take_row(std::size_t y);

  std::array<std::uint8_t, CellSet::side * CellSet::side> marks_{};
};

/// Cells that the processor fetches, a few at a time, while another tile is worked on: memory is what a scan
/// waits for.
class CellsAhead {
 public:
  CellsAhead() = default;
  /// Both must outlive this.
  CellsAhead(const FilterCell* cells, const CellList& list)
      : cells_(cells), next_(list.cells.data()), end_(next_ + list.count) {}

  void fetch_one() {
    if (next_ != end_) __builtin_prefetch(&cells_[*next_++], 1, second_cache);
  }
  void fetch_rest() {
    while (next_ != end_) fetch_one();
  }

 private:
  static constexpr int second_cache = 2;  ///< the first has no room for two tiles

  const FilterCell* cells_ = nullptr;
  const std::uint16_t* next_ = nullptr;
  const std::uint16_t* end_ = nullptr;
};

/// Up to 32 x 32 cells of the live height map.
///
/// Points that agree with their cell's prediction go into its sums. All others, and those of unknown cells,
/// are set aside, sorted; their lower surface begins a new cell, or replaces a known one when it persists.
/// A cell takes the sums in and moves on in time with the next scan that has points in it. Scans that follow
/// each other quickly say the same of a still bed: such a tile gathers their points and moves on once for all
/// of them. Everything is a function of what is known before the scan and of the set of the scan's points,
/// not of their order.
class FusionTile {
 public:
  static constexpr std::size_t side = CellSet::side;
  static constexpr std::size_t cell_count = side * side;

  /// Lets the processor fetch what the next scan needs first; its cells, of which `list` must live on,
  /// follow.
  CellsAhead prefetch(const CellList& list) const;
  /// Makes `scan` (at `time` [ms]) the open one, after the one before has had its say.
  void open(std::uint32_t scan, std::uint32_t time, const FusionRules& rules);
  /// Lets cells reach the open scan.
  void reach(const MarkedCells& marked, const FusionRules& rules, HeightSteps& steps, CellsAhead& ahead);
  /// Adds samples, whose cells have reached the open scan; how many agree with what is known.
  std::size_t add(const Sample* samples, std::size_t count, const FusionRules& rules, CellsAhead& ahead);
  /// What became of the points that were set aside in the open scan.
  struct Verdicts {
    std::size_t new_cells = 0;      ///< that begin, or begin anew
    std::size_t outlier_cells = 0;  ///< whose points were refused
    std::size_t outliers = 0;       ///< points of these cells that were refused
  };
  Verdicts verdicts(const FusionRules& rules);
  /// The open scan has been added to the one before.
  bool gathers() const { return gathers_; }

  /// Writes the estimates that have changed since they were last written.
  void write(const FusionRules& rules, const TileLayers& layers);
  /// Begins a cell from a known map at the tile's time; the open scan has no points in the tile yet.
  void begin_cell(std::size_t cell, const CellEstimate& known);
  /// Makes a cell unknown; likewise.
  void forget_cell(std::size_t cell);
  /// Somebody else has written what there is to say of a cell.
  void is_written(std::size_t cell) { unwritten_.remove(cell); }
  /// Moves on to the time `end`, which then is zero: the clock jumped back.
  void restart_clock(std::uint32_t end, const FusionRules& rules, HeightSteps& steps);
  /// Writes the number of points on which each known cell rests, the open scan included; rows `stride` apart.
  void write_counts(const FusionRules& rules, float* counts, std::size_t stride) const;

 private:
  enum class Verdict { agrees, refused, begins };

  bool gathers_on(std::uint32_t time, const FusionRules& rules) const;
  bool known(std::size_t cell) const { return cells_[cell].height_variance > 0; }
  /// Whether the still filter has run, and speaks, since the bed came to rest.
  bool rests(std::size_t cell) const { return still_ && cells_[cell].time >= still_since_; }
  void move_on(const CellList& list, const FusionRules& rules, HeightSteps& steps, CellsAhead& ahead);
  void judge_motion(std::uint32_t time);
  void take_set_aside(const FusionRules& rules);
  void forget_refusals();
  void sort_set_aside();
  int refusals_in_row(std::size_t cell, const SurfaceSum& sum, const FusionRules& rules) const;
  Verdict judge(std::size_t cell, const SurfaceSum& sum, const FusionRules& rules) const;

  // What each scan needs of a tile lies together at its beginning.
  CellSet open_;       ///< with points in the open scan
  CellSet unwritten_;  ///< whose estimates have changed
  bool any_refusals_ = false;
  std::vector<Sample> set_aside_;
  std::size_t sorted_ = 0;             ///< of those set aside, how many lie in order
  std::uint32_t scan_ = 0;             ///< 0: none
  std::uint32_t time_ = 0;             ///< of the open scan [ms]
  std::uint32_t gathering_since_ = 0;  ///< [ms]
  bool gathers_ = false;               ///< the open scan has been added to the one before
  bool still_ = false;
  std::uint32_t still_since_ = 0;  ///< when the still filters began [ms]
  MotionEvidence news_;            ///< in the open scan
  std::int64_t evidence_ = 0;      ///< that still_ is wrong [MotionEvidence::unit]
  std::array<FilterCell, cell_count> cells_;
  std::array<std::int32_t, cell_count> rival_{};     ///< where refused points lay [steps]
  std::array<std::uint8_t, cell_count> refusals_{};  ///< scans in a row whose points disagreed alike
};

}  // namespace aeolian
