#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/slide/calibration/rescaled_score.hpp"
#include "aeolian_core/slide/piles/pile_measure.hpp"
#include "aeolian_core/slide/piles/slide_scene.hpp"

namespace aeolian {

/// What is calibrated: three numbers of the snow, and the friction of the panel, which the thesis does not
/// report and which decides where piles lie.
struct SnowSet {
  double friction = 0.5;        ///< M
  double consolidation = 7000;  ///< p0 [Pa]
  double cohesion = 0.2;        ///< beta
  double panel_friction = 0.7;
};
SlideScene with_snow(SlideScene scene, const SnowSet& set);

/// Values of each; a list of one holds it.
struct SnowGrid {
  std::vector<double> friction{0.4, 0.5, 0.6, 0.7};
  std::vector<double> consolidation{4000, 5000, 6000, 7000};
  std::vector<double> cohesion{0.05, 0.1, 0.2};
  std::vector<double> panel_friction{0.7};
};
/// Every combination, the last number fastest. Throws Error for an empty list.
std::vector<SnowSet> sets_of(const SnowGrid& grid);

/// A pile in the laboratory.
struct LabPile {
  double tilt = 0;  ///< of the panel [rad]
  int event = 1;
  double height = 0;  ///< [m]
  double length = 0;  ///< [m]
};
/// Reads a table with the columns tilt_deg, event, height_m, length_m and no others. Throws Error naming the
/// file and what is wrong.
std::vector<LabPile> read_lab_piles(const std::string& file);

/// Root mean squares over the laboratory's piles; `simulated` has the pile for each. One that there is not,
/// because the slab was stuck, counts as a pile of no size.
PileErrors errors_against(const std::vector<LabPile>& lab,
                          const std::vector<std::optional<PileSize>>& simulated);

struct ScoredSet {
  SnowSet set;
  PileErrors errors;
  double score = 0;  ///< on the scale of the grid
};
struct SnowCalibration {
  std::vector<ScoredSet> grid;
  std::vector<ScoredSet> refined;  ///< what the optimiser tried, in its order
  ScoredSet best;                  ///< of all
};

/// Errors of some sets; nothing to stop.
using MeasureSets = std::function<std::optional<std::vector<PileErrors>>(const std::vector<SnowSet>&)>;

/// Scores every set of the grid (thesis, section 3.4), then goes on from the best between the ends of the
/// grid, without derivatives, for `refinements` sets (NLopt's Sbplx, after Rowan 1990: it bears noise).
/// Nothing when it was stopped. Throws Error when no two sets differ.
std::optional<SnowCalibration> calibrate(const SnowGrid& grid, int refinements, const MeasureSets& measure);

/// Index of sensitivity (Frischholz eq. 3.3.1): the relative change of a result over that of a number.
double sensitivity_index(double nominal_result, double altered_result, double nominal, double altered);

}  // namespace aeolian
