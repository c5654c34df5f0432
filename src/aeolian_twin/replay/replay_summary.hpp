#pragma once

#include <string>
#include <vector>

#include "aeolian_twin/replay/replay_bag.hpp"

namespace aeolian {

/// What became of one of several bags.
struct ReplayedBag {
  std::string name;     ///< of its folder
  std::string refused;  ///< one line; empty: it was replayed
  ReplayFigures figures;
};

/// One as a line, without its end, that another process can read.
std::string to_line(const ReplayedBag& bag);
ReplayedBag from_line(const std::string& line);

/// DIRECTORY/summary.csv and DIRECTORY/index.html: a row for each bag, with links to the reports.
void write_replay_summary(const std::vector<ReplayedBag>& bags, const std::string& directory);

}  // namespace aeolian
