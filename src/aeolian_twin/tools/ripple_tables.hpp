#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/tools/theory_tables.hpp"

namespace aeolian {

/// Writes ripples.csv: what each map says, a row per map.
inline void write_ripples(const RippleHistory& history, const std::string& path) {
  std::vector<std::vector<double>> rows;
  for (const TrackedMap& map : history.maps) {
    const RippleField& f = map.field;
    const auto degrees = [](double angle) { return radians_to_degrees(angle); };
    rows.push_back({map.time,
                    f.wavelength.value,
                    f.wavelength.sigma,
                    f.height.value,
                    f.height.sigma,
                    f.index.value,
                    degrees(f.orientation.value),
                    degrees(f.orientation.sigma),
                    f.concentration,
                    degrees(f.stoss_mean.value),
                    degrees(f.stoss_max.value),
                    degrees(f.lee_mean.value),
                    degrees(f.lee_max.value),
                    f.asymmetry.value,
                    static_cast<double>(f.crests),
                    f.crest_length,
                    static_cast<double>(f.terminations),
                    static_cast<double>(f.junctions),
                    f.defect_density.value,
                    f.defect_density.sigma,
                    f.defects_per_square_wavelength,
                    map.celerity.value,
                    map.celerity.sigma});
  }
  write_csv(table_of({"t_s",
                      "wavelength_m",
                      "wavelength_sigma_m",
                      "height_m",
                      "height_sigma_m",
                      "index",
                      "crest_orientation_deg",
                      "crest_orientation_sigma_deg",
                      "concentration",
                      "stoss_mean_deg",
                      "stoss_max_deg",
                      "lee_mean_deg",
                      "lee_max_deg",
                      "stoss_length_per_lee_length",
                      "crests",
                      "mean_crest_length_m",
                      "terminations",
                      "junctions",
                      "defects_per_m2",
                      "defects_sigma_per_m2",
                      "defects_per_square_wavelength",
                      "celerity_m_s",
                      "celerity_scatter_m_s"},
                     rows),
            path);
}

inline const char* name_of(CrestEnd end) {
  return end == CrestEnd::unseen ? "unseen" : end == CrestEnd::junction ? "junction" : "termination";
}

/// Writes crests.csv: each crest of each map, with the place of its middle point.
inline void write_crests(const RippleHistory& history, const std::string& path) {
  std::string text =
      "t_s,id,x_m,y_m,length_m,height_m,speed_m_s,speed_sigma_m_s,direction_deg,right_end,left_end\n";
  for (const TrackedMap& map : history.maps)
    for (std::size_t c = 0; c < map.motions.size(); ++c) {
      const CrestLine& crest = map.found.crests[c];
      const CrestMotion& motion = map.motions[c];
      const Eigen::Vector2d& middle = crest.points[crest.points.size() / 2];
      text += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{}\n", map.time, motion.id,
                          middle.x(), middle.y(), crest.length, crest.height, motion.speed.value,
                          motion.speed.sigma, radians_to_degrees(motion.direction), name_of(crest.right),
                          name_of(crest.left));
    }
  write_text_atomically(path, text);
}

/// Writes crest_lines.csv: the points of each crest of each map.
inline void write_crest_lines(const RippleHistory& history, const std::string& path) {
  std::vector<std::vector<double>> rows;
  for (const TrackedMap& map : history.maps)
    for (std::size_t c = 0; c < map.motions.size(); ++c)
      for (const Eigen::Vector2d& point : map.found.crests[c].points)
        rows.push_back({map.time, static_cast<double>(map.motions[c].id), point.x(), point.y()});
  write_csv(table_of({"t_s", "id", "x_m", "y_m"}, rows), path);
}

/// Writes events.csv, by time.
inline void write_events(const RippleHistory& history, const std::string& path) {
  std::string text = "kind,t_s,start_s,end_s,x_m,y_m,length_m,ratio_before,ratio_after\n";
  for (const RippleEvent& e : history.events)
    text += fmt::format("{},{},{},{},{},{},{:.6g},{:.4g},{:.4g}\n", name_of(e.kind), e.time, e.start, e.end,
                        e.place.x(), e.place.y(), e.length, e.ratio_before, e.ratio_after);
  write_text_atomically(path, text);
}

}  // namespace aeolian
