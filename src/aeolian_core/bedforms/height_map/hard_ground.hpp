#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "aeolian_core/bedforms/height_map/wind_frame.hpp"

namespace aeolian {

/// Depth of sand of which less, by itself, does not move [m]: far less than a grain.
constexpr double least_movable = 1e-5;

/// What of a bed cannot move, in a wind frame with pads filled. A bed without any has empty fields, and runs
/// without looking at them.
struct HardGround {
  static constexpr double bottomless = -1e30;

  FrameField floor;  ///< height below which the wind erodes nothing [m]; `bottomless` where there is none
  FrameField open;   ///< 1, or 0 where the bed is unknown: sand passes over it and none comes to rest there

  bool holes = false;  ///< whether `open` is zero anywhere

  bool any() const { return floor.rows() > 0; }
};

/// Runs of 32 rows at a station that have something to do: one flag each. Beds without hard ground have them
/// all.
class ActivePatches {
 public:
  static constexpr int rows_each = 32;

  ActivePatches(int stations, int rows)
      : rows_(rows),
        patches_((rows + rows_each - 1) / rows_each),
        active_(static_cast<std::size_t>(stations) * static_cast<std::size_t>(patches_), 1) {}

  int patches() const { return patches_; }
  bool get(int station, int patch) const { return active_[at(station, patch)] != 0; }
  void set(int station, int patch, bool active) { active_[at(station, patch)] = active ? 1 : 0; }
  /// Flags the patches of the rows [begin, end), cut off at the first and last row.
  void activate_rows(int station, int begin, int end) {
    const int last = std::min(end, rows_) - 1;
    for (int row = std::max(begin, 0); row <= last; row = (row / rows_each + 1) * rows_each)
      active_[at(station, row / rows_each)] = 1;
  }
  bool any(int station, int begin, int end) const {
    const int last = std::min(end, rows_) - 1;
    for (int row = std::max(begin, 0); row <= last; row = (row / rows_each + 1) * rows_each)
      if (active_[at(station, row / rows_each)]) return true;
    return false;
  }
  void fill(bool active) { std::fill(active_.begin(), active_.end(), active ? 1 : 0); }

  /// Calls work(station, patch, begin, end) for each active patch; [begin, end) are its rows.
  template <class Work>
  void for_all(Work&& work) const {
    const int stations = static_cast<int>(active_.size()) / patches_;
    for (int station = 0; station < stations; ++station)
      for (int patch = 0; patch < patches_; ++patch)
        if (get(station, patch))
          work(station, patch, patch * rows_each, std::min((patch + 1) * rows_each, rows_));
  }
  /// Calls work(begin, end) for each run of rows whose patches are active.
  template <class Work>
  void for_runs(int station, Work&& work) const {
    int begin = -1;
    for (int patch = 0; patch <= patches_; ++patch) {
      const bool active = patch < patches_ && get(station, patch);
      if (active && begin < 0) begin = patch * rows_each;
      if (!active && begin >= 0) {
        work(begin, std::min(patch * rows_each, rows_));
        begin = -1;
      }
    }
  }

 private:
  std::size_t at(int station, int patch) const {
    return static_cast<std::size_t>(station) * static_cast<std::size_t>(patches_) +
           static_cast<std::size_t>(patch);
  }

  int rows_;
  int patches_;
  std::vector<std::uint8_t> active_;
};

}  // namespace aeolian
