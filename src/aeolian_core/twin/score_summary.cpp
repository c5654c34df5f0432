#include "aeolian_core/twin/score_summary.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {

Spread spread_of(const std::vector<double>& values) {
  std::vector<double> sample;
  for (const double v : values)
    if (!std::isnan(v)) sample.push_back(v);
  return {quantile(sample, 0.5), quantile(sample, 0.25), quantile(sample, 0.75)};
}

Spread LeadSummary::spread(double Comparison::*number) const {
  std::vector<double> values;
  for (const Run::Score& score : scores) values.push_back(score.comparison.*number);
  return spread_of(values);
}

std::vector<LeadSummary> summarise_by_lead(const std::vector<Run::Score>& scores) {
  std::vector<const Run::Score*> sorted;
  sorted.reserve(scores.size());
  for (const Run::Score& score : scores) sorted.push_back(&score);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Run::Score* a, const Run::Score* b) { return a->lead_time < b->lead_time; });
  std::vector<LeadSummary> result;
  for (auto first = sorted.begin(); first != sorted.end();) {
    const double longest = (*first)->lead_time + std::max(0.5, 0.02 * (*first)->lead_time);
    LeadSummary summary;
    std::vector<double> leads;
    for (; first != sorted.end() && (*first)->lead_time <= longest; ++first) {
      leads.push_back((*first)->lead_time);
      summary.scores.push_back(**first);
    }
    summary.lead_time = quantile(leads, 0.5);
    result.push_back(std::move(summary));
  }
  return result;
}

}  // namespace aeolian
