#pragma once

#include <vector>

#include "aeolian_core/twin/report.hpp"

namespace aeolian {

/// A number over several forecasts; NaN where none of them has it.
struct Spread {
  double median = 0;
  double lower = 0;  ///< quartile
  double upper = 0;  ///< quartile
};

/// The spread of the values that are not NaN.
Spread spread_of(const std::vector<double>& values);

/// All forecasts with one lead time.
struct LeadSummary {
  double lead_time = 0;  ///< median [s]
  std::vector<Run::Score> scores;

  /// The spread of one number of the comparisons.
  Spread spread(double Comparison::*number) const;
};

/// Scores by lead time, shortest first. Lead times within 2 % of one another (or half a second) are one: time
/// stamps of maps and forecasts need not agree to the last digit.
std::vector<LeadSummary> summarise_by_lead(const std::vector<Run::Score>& scores);

}  // namespace aeolian
