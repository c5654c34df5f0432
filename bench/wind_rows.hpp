#pragma once

#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/wind.md, each in its own file wind_NAME_rows.cpp.
/// @{
void linear_rows(
    AccuracyTable& table);  ///< log law, hills in linear theory, stress and its phase (F1 to F6, F9 to F11)
void volume_rows(AccuracyTable& table);     ///< non-linear potential flow, lift, mass (F2, F7, F8, C2, C3)
void askervein_rows(AccuracyTable& table);  ///< G1, G2
void gust_rows(AccuracyTable& table);       ///< E1, E2
void sph_rows(AccuracyTable& table);        ///< the air of particles (A, B, C, F1 to F3, F7), and the thesis'
/// @}

}  // namespace aeolian
