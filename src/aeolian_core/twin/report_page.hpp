#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/report.hpp"
#include "aeolian_core/twin/score_summary.hpp"

namespace aeolian {

/// A picture of the report with the words below it.
struct Picture {
  std::string file;  ///< beside the page
  std::string title;
  std::string caption;
};

/// How far measured map and forecast are from the true surface.
struct TruthStatistics {
  DifferenceStatistics measured;
  std::optional<DifferenceStatistics> forecast;
  Picture picture;  ///< measured map minus truth
};

/// What the page shows, computed and drawn already.
struct PageContents {
  const Run& run;
  std::vector<LeadSummary> leads;
  std::vector<Picture> maps;
  std::optional<Picture> growth;
  std::optional<Picture> skill;
  std::optional<TruthStatistics> truth;
  std::vector<std::string> tables;  ///< files beside the page
};

/// The verdict on the forecast in one or two sentences of plain text, with its numbers.
std::string verdict(const Run& run, const std::vector<LeadSummary>& leads);

/// The page as HTML: self-contained but for its pictures, no script, no network.
std::string report_page(const PageContents& contents);

}  // namespace aeolian
