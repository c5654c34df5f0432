#pragma once

#include <string>
#include <vector>

#include "aeolian_core/slide/piles/slide_scene.hpp"

namespace aeolian {

/// What decides a pile below a panel, for one snow and one friction.
struct PileQuery {
  double panel_length = 2;   ///< along the slope, and that of the slab [m]
  double panel_height = 1;   ///< of the panel's lower edge above the ground [m]
  double tilt = 0.69813170;  ///< below the horizontal [rad]
  double thickness = 0.05;   ///< of the slab, normal to the panel [m]
  int event = 1;             ///< slabs that have slid, from 1
};

/// A pile that was simulated.
struct PileRecord {
  int run = 0;  ///< records of one run are one pile that grows: they are not independent
  PileQuery query;
  double cell = 0;    ///< of the solver's grid [m]
  double height = 0;  ///< [m]
  double length = 0;  ///< [m]
  double head = 0;    ///< x of the end nearest to the panel's centre [m]
  double tail = 0;    ///< x of the far end [m]
  double shape() const { return height / length; }
};
using PileTable = std::vector<PileRecord>;

/// The scene of a query: that of `base` but for the panel and slab, with so many cells in the thickness.
SlideScene scene_for(const PileQuery& query, const SlideScene& base, double cells_per_thickness);

/// Reads a table with the columns run, panel_length_m, panel_height_m, tilt_deg, thickness_m, event, cell_m,
/// height_m, length_m, head_m, tail_m and no others. Throws Error naming the file and what is wrong: another
/// column, no row, a number that is not allowed, a run of two panels or with an event twice.
PileTable read_pile_table(const std::string& file);
/// Writes it atomically, below the lines of the comment.
void write_pile_table(const PileTable& table, const std::string& file, const std::string& comment);

}  // namespace aeolian
