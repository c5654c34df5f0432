#pragma once

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"

namespace aeolian {

/// Lets loose grains slide where they lie steeper than repose: from each cell half of the excess over repose
/// goes to the steepest of the eight neighbours below it, as much as there is of loose grains (specification
/// sec. 3.3). All cells of a sweep slide at once: equally steep neighbours share, and what several cells
/// bring to one is shortened so that it is not raised beyond them. So the result mirrors where the bed does.
/// Borders that are not periodic are walls; nothing slides onto holes.
///
/// Begins with the bed's dirty cells and forgets those that are at rest. At most `sweeps`; what still slides
/// then stays dirty. Returns the units moved. `landed(cell, units)` is told what arrives.
template <class Landed>
std::int64_t slide(ErodibleBed& bed, double tan_repose, int sweeps, Landed&& landed);

/// One sweep: who gives how much to whom, from the bed as it is, in order of the cells.
class SlideSweep {
 public:
  struct Move {
    std::size_t from, to;
    std::int32_t units;
  };
  /// Over the bed's dirty cells, which are forgotten.
  const std::vector<Move>& find(ErodibleBed& bed, double tan_repose);

 private:
  struct Donor {
    std::size_t cell;
    float excess;            ///< over repose, towards the steepest neighbours [m]
    std::uint8_t receivers;  ///< a bit for each neighbour that is as steep
  };
  std::vector<Donor> donors_;
  std::vector<std::uint8_t> givers_;  ///< to each cell
  std::vector<Move> moves_;
};

template <class Landed>
std::int64_t slide(ErodibleBed& bed, double tan_repose, int sweeps, Landed&& landed) {
  SlideSweep sweep;
  std::int64_t moved = 0;
  for (int n = 0; n < sweeps; ++n) {
    const std::vector<SlideSweep::Move>& moves = sweep.find(bed, tan_repose);
    if (moves.empty()) break;
    for (const SlideSweep::Move& m : moves) {
      bed.add_loose(m.from, -m.units);
      bed.add_loose(m.to, m.units);
      landed(m.to, m.units);
      moved += m.units;
    }
  }
  return moved;
}

}  // namespace aeolian
