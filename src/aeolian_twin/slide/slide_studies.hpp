#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "aeolian_core/slide/surrogate/pile_design.hpp"
#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"
#include "aeolian_twin/slide/slide_config.hpp"

namespace aeolian {

/// What all studies of many slides share.
struct StudyOptions {
  std::string out;  ///< folder for results and for the journal of what is done
  std::uint64_t seed = 1;
  int threads = 0;
  bool fresh = false;
  std::string command;
  const std::atomic<bool>& stop;
};
constexpr int stopped_code = 130;  ///< as a shell has it for a program that Ctrl-C has ended

/// A file like config/slide/piles_2d.yaml in numbers.
struct PileTableConfig {
  SlideConfig base;  ///< its snow, friction, particles and way between events
  PileDesign design;
  double cells_per_thickness = 3;
  int events = 5;
};
/// Throws Error naming file, line, key, value and what is allowed.
PileTableConfig read_pile_table_config(const std::string& file);

/// Runs a scene's events, writes and draws them; keeps those that are over when it is stopped. The exit code.
int run_slides(const SlideConfig& config, int dimensions, const std::string& command, const std::string& out,
               const std::atomic<bool>& stop);

/// A study writes its results into the folder and gives the program's exit code: 0, or 130 when it was
/// stopped; the same command then goes on. Under mpirun every process takes its share and the first writes.
/// @{

/// Simulates the piles of a table: NAME.csv, the surrogate trained on it, NAME_surrogate.yaml, and what it
/// predicts of panels that it was not taught, NAME_predicted.svg; NAME is that of the config.
int make_pile_table(const std::string& config, const StudyOptions& options);

/// Calibrates the snow on the laboratory's piles (columns tilt_deg, event, height_m, length_m) as the config
/// says, see config/slide/calibration.yaml: calibration.csv, a row a set, and calibrated.yaml, a scene.
int calibrate_snow(const std::string& config, const std::string& lab, const StudyOptions& options);

/// Indices of sensitivity, one number at a time, as config/slide/sensitivity.yaml says: sensitivity.csv and
/// sensitivity.svg.
int study_sensitivity(const std::string& config, const StudyOptions& options);
/// @}

/// Trains both kernels on a table and keeps the one that is better in shape H/L over folds of whole runs.
SlideSurrogate best_surrogate(const PileTable& table, std::uint64_t seed);

/// Draws what is predicted over what was simulated, each panel by what the others have taught.
void plot_predicted(const PileTable& table, const SlideSurrogate& surrogate, std::uint64_t seed,
                    const std::string& file);

/// Where `rosrun` finds what the package ships, config/slide; throws Error when there is no such package.
std::string shipped_slide_folder();

/// Prints the pile of a query: from the surrogate beside the config, NAME_surrogate.yaml, or by simulation
/// where that knows nothing, and says which. The exit code, as above.
int predict_pile(const std::string& config, const PileQuery& query, int threads,
                 const std::atomic<bool>& stop);

}  // namespace aeolian
