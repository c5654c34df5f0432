#pragma once

#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/splash.md, each in its own file splash_NAME_rows.cpp.
/// @{
void rebound_rows(AccuracyTable& table);     ///< rebound model (splash specification, secs. 5.5 and 5.6)
void experiment_rows(AccuracyTable& table);  ///< experiment with coarse sand (sec. 5.7), slopes (sec. 3.7)
void literature_rows(AccuracyTable& table);  ///< splash functions of the literature (secs. 6 and 7)
void table_rows(AccuracyTable& table);       ///< tables of events against what they were made from
/// @}

/// Prints a script for gnuplot that draws how the splash functions differ, as a PNG on its standard output.
void print_splash_figure();

}  // namespace aeolian
