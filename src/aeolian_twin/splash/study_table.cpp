#include "aeolian_twin/splash/study_table.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

/// The experiment's number of ejecta over ours, at most 1.
double share_to_keep(const StudySettings& study, const std::vector<StudyPoint>& points) {
  const double unit = std::sqrt(gravity * study.diameter);
  const auto measured = [&](const StudyPoint& p) {
    return p.speed >= 65 * unit && p.speed <= 140 * unit && p.angle > 9.9 * degree && p.angle < 21.1 * degree;
  };
  const bool some = std::any_of(points.begin(), points.end(), measured);
  double wanted = 0;
  double counted = 0;
  for (const StudyPoint& point : points) {
    if ((some && !measured(point)) || std::abs(point.size_ratio - 1) > 0.01) continue;
    wanted += CoarseSandSettings::instance().mean_number(point.speed / unit, point.angle);
    counted += point.statistics.number.mean;
  }
  return wanted > 0 && counted > wanted ? wanted / counted : 1;
}

}  // namespace

SplashTable study_table(const StudySettings& study, const std::vector<StudyPoint>& points,
                        const std::string& command) {
  std::vector<SplashCase> cases;
  for (const StudyPoint& point : points) {
    SplashCase one;
    one.impact.speed = point.speed;
    one.impact.angle = point.angle;
    one.impact.size_ratio = point.size_ratio;
    one.impact.roughness = point.roughness;
    for (const ImpactOutcome& outcome : point.outcomes)
      if (outcome.contact) one.events.push_back(splash_event(outcome, 0.5 * study.diameter));
    cases.push_back(std::move(one));
  }
  SplashTableSource source;
  source.command = command;
  source.material = study.name;
  if (study.calibrated) source.ejecta_kept = share_to_keep(study, points);
  return SplashTable::build(cases, study.diameter, source, study.seed);
}

}  // namespace aeolian
