#pragma once

#include <string>
#include <vector>

#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_twin/splash/study.hpp"

namespace aeolian {

/// The study as a SplashTable for the saltation model, with the command that made it. Where the settings ask
/// for the number of ejecta of the coarse-sand experiment, a share of the ejecta is kept such that the mean
/// number over the study's impacts at 65 to 140 sqrt(g d) and 10 to 21 degrees, all where there is none of
/// those, by grains of the bed's size is the experiment's; all are kept where fewer were counted. Throws
/// Error when the grid has a hole.
SplashTable study_table(const StudySettings& study, const std::vector<StudyPoint>& points,
                        const std::string& command);

}  // namespace aeolian
