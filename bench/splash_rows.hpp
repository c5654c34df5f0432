#pragma once

#include <string>

#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/splash.md, each in its own file splash_NAME_rows.cpp.
/// @{
void rebound_rows(AccuracyTable& table);     ///< rebound model (splash specification, secs. 5.5 and 5.6)
void experiment_rows(AccuracyTable& table);  ///< experiment with coarse sand (sec. 5.7), slopes (sec. 3.7)
void literature_rows(AccuracyTable& table);  ///< splash functions of the literature (secs. 6 and 7)
void table_rows(AccuracyTable& table);       ///< tables of events against what they were made from
/// Simulated impacts (secs. 5.2 to 5.4); takes minutes. Impacts are noted in the folder as they are done:
/// after an interruption the same folder goes on from there.
void impact_rows(AccuracyTable& table, const std::string& folder);
void contact_state_rows(AccuracyTable& table);  ///< effective mass (check S3), a part of those
void shipped_rows(AccuracyTable& table);        ///< the tables in config/splash/tables against experiments
void box_rows(AccuracyTable& table, const std::string& folder);  ///< impacts in a larger box (trap T12)
void sleep_rows(AccuracyTable& table);                           ///< impacts among sleeping grains
/// @}

/// Prints a script for gnuplot that draws how the splash functions differ, as a PNG on its standard output.
void print_splash_figure();

}  // namespace aeolian
