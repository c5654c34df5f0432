#include "aeolian_twin/splash/study_quantities.hpp"

#include <cmath>
#include <limits>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

MeanValue in_degrees(MeanValue value) {
  return {value.mean / degree, value.half_width / degree, value.error / degree, value.count};
}

MeanValue share(int part, int all) {
  const double p = static_cast<double>(part) / all;
  return {p, std::sqrt(p * (1 - p)), std::sqrt(p * (1 - p) / all), all};
}

}  // namespace

std::vector<Quantity> quantities(const ImpactStatistics& s) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<Quantity> list = {
      {"captured", share(s.captured, s.impacts)},
      {"backward_rebounds", share(s.backward, s.impacts)},
      {"rebound_along", s.along},
      {"rebound_up", s.up},
      {"rebound_speed", s.speed},
      {"rebound_angle_deg", in_degrees(s.rebound_angle)},
      {"rebound_rolling", s.rolling},
      {"normal_angle_deg", in_degrees(s.normal_angle)},
      {"bed_along", s.bed_along},
      {"bed_down", s.bed_down},
      {"bed_angle_deg", in_degrees(s.bed_angle)},
      {"effective_mass", s.effective_mass},
      {"effective_mass_median", {s.effective_mass_median, unknown, unknown, s.effective_mass.count}},
      {"bed_energy", s.bed_energy},
      {"ejecta_number", s.number},
      {"ejecta_speed_m_s", s.ejecta_speed},
      {"ejecta_upward_m_s", s.ejecta_upward},
      {"ejecta_angle_deg", in_degrees(s.ejecta_angle)},
      {"reptation_m", s.reptation},
      {"ejected_momentum_along", s.ejected_along},
      {"ejected_momentum_up", s.ejected_up},
      {"ejected_energy", s.ejected_energy},
      {"origin_along_m", s.origin_along},
      {"origin_up_m", s.origin_up},
      {"origin_distance_m", s.origin_distance},
      {"from_upper_layers", {s.from_upper_layers, unknown, unknown, s.origin_up.count}},
  };
  for (const Origin origin : ejecta_origins) {
    const auto found = s.by_origin.find(origin);
    if (found == s.by_origin.end()) continue;
    const EjectaShare& ejecta = found->second;
    const std::string prefix = name_of(origin);
    list.push_back({prefix + "_number", ejecta.number});
    list.push_back({prefix + "_angle_deg", in_degrees(ejecta.angle)});
    list.push_back({prefix + "_momentum_share", ejecta.momentum});
    list.push_back({prefix + "_reptation_m", ejecta.reptation});
  }
  return list;
}

}  // namespace aeolian
