#pragma once

#include <string>
#include <vector>

#include "aeolian_twin/splash/study.hpp"

namespace aeolian {

/// One row an impact: what was fired, the first contact, the rebound and a sum over the ejecta.
void write_events_csv(const std::vector<StudyPoint>& points, const std::string& path);
/// One row a grain that rose; `impact` and `point` are those of the events.
void write_ejecta_csv(const std::vector<StudyPoint>& points, const std::string& path);
/// One row a number: mean, half-width of the distribution and standard error, beside those of the thesis when
/// the study is one of its cases.
void write_summary_csv(const StudySettings& study, const std::vector<StudyPoint>& points,
                       const std::string& path);
/// One row a bed: what can be said about it at rest.
template <int Dim>
void write_beds_csv(const StudyBeds<Dim>& beds, const std::string& path);

extern template void write_beds_csv(const StudyBeds<2>&, const std::string&);
extern template void write_beds_csv(const StudyBeds<3>&, const std::string&);

}  // namespace aeolian
