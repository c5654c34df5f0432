#pragma once

#include "../test/aeolian_core/saltation/thesis_bed.hpp"
#include "accuracy_table.hpp"

namespace aeolian {

/// The parts of docs/accuracy/saltation.md, each in its saltation_NAME_rows.cpp.
/// @{
void conveyor_rows(AccuracyTable& table);
void state_rows(AccuracyTable& table);    ///< table 4.5 and thresholds
void profile_rows(AccuracyTable& table);  ///< trajectories, winds, table 4.4, focus
void flux_rows(AccuracyTable& table);     ///< flux law, heights of flights
void sand_rows(AccuracyTable& table);     ///< coarse sand, real sand
void mixture_rows(AccuracyTable& table);  ///< several sizes
void step_rows(AccuracyTable& table);     ///< how many steps states take
/// @}

constexpr double percent = 0.01;

inline SaltationSolver thesis_solver(int number, double drag_scale = 1) {
  return {thesis_bed(drag_scale), thesis_splash(number)};
}

inline std::string name_of(int number, double u) { return fmt::format("case {}, u* {:g}", number, u); }

}  // namespace aeolian
