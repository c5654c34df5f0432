#pragma once

#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/ripples.md, each in its own file ripple_NAME_rows.cpp.
/// @{
void theory_rows(AccuracyTable& table);   ///< kinematics, worms, collisions, mergers, Haff's bed (rows 13-23)
void lattice_rows(AccuracyTable& table);  ///< the lattice bed in two dimensions (rows 24-27)
void model_rows(AccuracyTable& table);    ///< the height-map model (rows 28, 30, 32-34), any wind, any grid
void comparison_rows(AccuracyTable& table);  ///< the height-map model against the lattice bed of grains
void tracking_rows(AccuracyTable& table);    ///< times, events and shapes of grown ripples (rows 29, 31, 32)
void sorting_rows(AccuracyTable& table);     ///< two sizes of grains, roughness below the grid
/// @}

}  // namespace aeolian
