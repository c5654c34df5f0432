#include "aeolian_twin/ripples/ripple_run_files.hpp"

#include <cmath>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {

WindSection middle_section(const HeightMap& map, double direction, double time) {
  const GridGeometry& g = map.geometry();
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  // Half the way through the map along the wind.
  const double half = std::min(std::abs(c) > 1e-9 ? 0.5 * g.length_x() / std::abs(c) : 1e300,
                               std::abs(s) > 1e-9 ? 0.5 * g.length_y() / std::abs(s) : 1e300);
  const double middle_x = g.origin_x() + 0.5 * g.length_x();
  const double middle_y = g.origin_y() + 0.5 * g.length_y();
  WindSection section{time, {}, {}};
  for (double along = 0.5 * g.cell(); along < 2 * half; along += g.cell()) {
    section.along.push_back(along);
    section.height.push_back(
        sample(g, map.layer(layer::elevation), middle_x + (along - half) * c, middle_y + (along - half) * s));
  }
  return section;
}

void write_ripple_history(const RippleRun& run, const std::string& folder) {
  Table table{
      {"t_s", "wavelength_m", "height_m", "index", "stoss_deg", "lee_deg", "speed_m_s", "volume_error"},
      std::vector<std::vector<double>>(8)};
  for (const RippleMoment& m : run.moments) {
    const double row[] = {m.time,
                          m.ripples.wavelength,
                          m.ripples.height,
                          m.ripples.index,
                          radians_to_degrees(m.ripples.stoss_slope),
                          radians_to_degrees(m.ripples.lee_slope),
                          m.speed,
                          m.volume_error};
    for (std::size_t i = 0; i < table.columns.size(); ++i) table.columns[i].push_back(row[i]);
  }
  write_csv(table, folder + "/ripples.csv");
}

}  // namespace aeolian
