#pragma once

#include <string>
#include <vector>

#include "aeolian_twin/splash/study.hpp"

namespace aeolian {

/// Histograms as the thesis has them (figs. 3.5 and 3.28): speed, vertical speed, angle and origin of the
/// ejecta of one series of impacts.
void plot_histograms(const StudyPoint& point, double diameter, const std::string& title,
                     const std::string& path);

/// What depends on speed and angle: number and speed of ejecta over the speed of impact, a curve an angle,
/// and the rebound over the angle, for the size ratio nearest to 1, a line style a kind of bed.
void plot_trends(const std::vector<StudyPoint>& points, double diameter, const std::string& title,
                 const std::string& path);

}  // namespace aeolian
