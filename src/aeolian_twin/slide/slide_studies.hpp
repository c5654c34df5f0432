#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "aeolian_core/slide/surrogate/pile_design.hpp"
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

/// A file like config/slide/piles_2d.yaml in numbers.
struct PileTableConfig {
  SlideConfig base;  ///< its snow, friction, particles and way between events
  PileDesign design;
  double cells_per_thickness = 3;
  int events = 5;
};
/// Throws Error naming file, line, key, value and what is allowed.
PileTableConfig read_pile_table_config(const std::string& file);

/// A study writes its results into the folder and gives the program's exit code: 0, or 130 when it was
/// stopped; the same command then goes on.
/// @{
/// Simulates the piles of a table: writes NAME.csv, and the surrogate that is trained on it as NAME.surrogate,
/// where NAME is that of the config.
int make_pile_table(const std::string& config, const StudyOptions& options);
/// @}

}  // namespace aeolian
