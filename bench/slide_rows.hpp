#pragma once

#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/slide.md, each in its own file slide_NAME_rows.cpp.
/// @{
void slide_law_rows(AccuracyTable& table);          ///< return mapping, score of a calibration
void slide_engine_rows(AccuracyTable& table);       ///< the solver against what is known exactly
void slide_collapse_rows(AccuracyTable& table);     ///< collapse of granular columns
void slide_pile_rows(AccuracyTable& table);         ///< piles: convergence, trends
void slide_sensitivity_rows(AccuracyTable& table);  ///< what each number of the snow does
void slide_calibration_rows(AccuracyTable& table);  ///< whether a calibration finds what a laboratory had
void slide_surrogate_rows(AccuracyTable& table);    ///< support vectors on the shipped table
/// @}

}  // namespace aeolian
