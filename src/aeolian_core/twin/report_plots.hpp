#pragma once

#include <string>
#include <vector>

#include "aeolian_core/twin/report.hpp"
#include "aeolian_core/twin/score_summary.hpp"

namespace aeolian {

/// Draws wavelength, height and friction velocity of the measured maps over time, with the forecasts of the
/// longest lead beside them, into an SVG file.
void plot_growth(const Run& run, const std::vector<LeadSummary>& leads, const std::string& path);

/// Draws the error of forecast and baselines, and the skill, by lead time (median and quartiles) into an SVG
/// file.
void plot_skill(const std::vector<LeadSummary>& leads, const std::string& path);

}  // namespace aeolian
