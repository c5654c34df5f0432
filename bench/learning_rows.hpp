#pragma once

#include <string>

#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/learning.md, each in its own file learning_NAME_rows.cpp. `folder` keeps the
/// days.
/// @{
void same_model_rows(AccuracyTable& table, const std::string& folder);   ///< which parameters come back
void lattice_day_rows(AccuracyTable& table, const std::string& folder);  ///< truth is another model
void scanned_day_rows(AccuracyTable& table, const std::string& folder);  ///< the forecaster, live
void noisy_day_rows(AccuracyTable& table, const std::string& folder);    ///< the same, on periodic days
/// @}

}  // namespace aeolian
