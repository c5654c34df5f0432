#pragma once

#include "accuracy_table.hpp"

#include "aeolian_core/saltation/distribution_kernel.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// The parts of docs/accuracy/saltation.md, each in its saltation_NAME_rows.cpp.
/// @{
void conveyor_rows(AccuracyTable& table);
void state_rows(AccuracyTable& table);    ///< table 4.5 and thresholds
void profile_rows(AccuracyTable& table);  ///< trajectories, winds, table 4.4, focus
void flux_rows(AccuracyTable& table);     ///< flux law, heights of flights
void sand_rows(AccuracyTable& table);     ///< coarse sand, real sand
void mixture_rows(AccuracyTable& table);  ///< several sizes
/// @}

constexpr double percent = 0.01;

/// Sand and air of the thesis (saltation specification, sec. 4).
inline SaltatingBed thesis_bed(double drag_scale = 1) {
  SaltatingBed bed;
  bed.grain.diameter = 0.00025;
  bed.grain.density = 2600;
  bed.atmosphere = {1.23, 1.46e-5, 9.81};
  bed.drag_law = DragLaw::sphere;
  bed.drag_scale = drag_scale;
  return bed;
}

inline SaltationSolver thesis_solver(int number, double drag_scale = 1) {
  return {thesis_bed(drag_scale), DistributionKernel(DistributionSplash::thesis_case(number))};
}

inline std::string name_of(int number, double u) { return fmt::format("case {}, u* {:g}", number, u); }

}  // namespace aeolian
