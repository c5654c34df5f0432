#pragma once

#include <vector>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/twin/report.hpp"
#include "aeolian_core/twin/score_summary.hpp"

namespace aeolian {

/// One row for each measured map, SI.
Table ripple_table(const Run& run);
/// One row for each scored forecast, SI.
Table score_table(const Run& run);
/// One row for each lead time: median and quartiles of every score, SI.
Table lead_table(const std::vector<LeadSummary>& leads);

}  // namespace aeolian
