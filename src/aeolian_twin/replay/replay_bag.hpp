#pragma once

#include <array>
#include <exception>
#include <functional>
#include <string>

#include "aeolian_twin/replay/replay_config.hpp"

namespace aeolian {

/// What a replay of a bag came to, in figures.
struct ReplayFigures {
  double duration = 0;  ///< from the first map to the last [s]
  double maps = 0;
  double forecasts = 0;
  double scored = 0;
  double lead_time = 0;          ///< the longest that was scored; NaN: none, and so below [s]
  double rmse = 0;               ///< of it, median [m]
  double skill_persistence = 0;  ///< of it, median
  double skill_translation = 0;  ///< of it, median
};

/// All of them, with their names in tables.
struct ReplayFigure {
  const char* name;
  double ReplayFigures::*value;
};
inline constexpr std::array<ReplayFigure, 8> replay_figures{
    {{"duration_s", &ReplayFigures::duration},
     {"maps", &ReplayFigures::maps},
     {"forecasts", &ReplayFigures::forecasts},
     {"scored", &ReplayFigures::scored},
     {"lead_time_s", &ReplayFigures::lead_time},
     {"rmse_m", &ReplayFigures::rmse},
     {"skill_persistence", &ReplayFigures::skill_persistence},
     {"skill_translation", &ReplayFigures::skill_translation}}};

/// What a program wants to know while a bag is replayed.
struct ReplayWatch {
  std::function<void(double share)> progress;             ///< of the bag, 0 to 1
  std::function<void(const std::string& line)> complain;  ///< what is amiss in the bag
  std::function<bool()> stopped;                          ///< whether a person wants it to end
};

/// A person stopped it.
class ReplayStopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

/// Runs the twin on a bag: DIRECTORY/twin.bag with what the nodes would have published, DIRECTORY/report with
/// a page about it, DIRECTORY/learned.yaml with what was learned, and DIRECTORY/made_from.txt, last. When
/// that file says that the same bag and parameters have already led to what is there, nothing is done. Throws
/// Error naming the bag, and ReplayStopped; a twin.bag is then as it was.
ReplayFigures replay_bag(const std::string& bag, const ReplayConfig& config, const std::string& directory,
                         const ReplayWatch& watch);

}  // namespace aeolian
