#include <cmath>

#include "aeolian_core/twin/report_page.hpp"
#include "aeolian_core/twin/report_text.hpp"

namespace aeolian {
namespace {

constexpr double telling_skill = 0.05;  // less is no difference that a person should act on

std::string why_no_score(const Run& run) {
  const std::string none = "No forecast could be scored: ";
  if (run.forecasts == 0) return none + "the run holds no forecast.";
  const std::string count = std::to_string(run.forecasts);
  const std::string made = run.forecasts == 1 ? "one forecast was made, but no measured map was"
                                              : count + " forecasts were made, but no measured map was";
  return none + made + " recorded at the time of validity of any.";
}

}  // namespace

std::string verdict(const Run& run, const std::vector<LeadSummary>& leads) {
  if (leads.empty()) return why_no_score(run);
  const LeadSummary& longest = leads.back();
  const double rmse = longest.spread(&Comparison::rmse).median;
  const double persistence = longest.spread(&Comparison::rmse_persistence).median;
  const double skill = longest.spread(&Comparison::skill_persistence).median;
  const Unit unit = length_unit(std::max(rmse, persistence));
  const std::size_t count = longest.scores.size();
  const std::string ahead = duration_text(longest.lead_time) + " ahead";
  const std::string numbers =
      "its error is " + quantity_text(rmse, unit) + " against " + quantity_text(persistence, unit) +
      " (RMSE, " + (count == 1 ? "one forecast" : "median of " + std::to_string(count) + " forecasts") +
      "; skill " + skill_text(skill) + ").";
  if (skill >= telling_skill)
    return "Looking " + ahead + ", the forecast is better than assuming that nothing changes: " + numbers +
           " It explains " + std::to_string(std::lround(100 * skill)) +
           " % of the squared change of the surface.";
  if (skill > -telling_skill)
    return "Looking " + ahead +
           ", the forecast is as good as assuming that nothing changes, and no better: " + numbers;
  return "Looking " + ahead + ", the forecast is worse than assuming that nothing changes: " + numbers;
}

}  // namespace aeolian
