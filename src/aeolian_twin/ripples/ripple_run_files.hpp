#pragma once

#include <string>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_twin/ripples/ripple_run.hpp"

namespace aeolian {

/// The heights along the wind through the middle of a map at one time.
struct WindSection {
  double time = 0;             ///< [s]
  std::vector<double> along;   ///< distance along the wind [m], from the border upwind
  std::vector<double> height;  ///< [m], NaN where unknown
};

WindSection middle_section(const HeightMap& map, double direction, double time);

/// Writes ripples.csv: one row a moment.
void write_ripple_history(const RippleRun& run, const std::string& folder);
/// Draws ripples.svg: wavelength, height and speed against time.
void plot_ripple_history(const RippleRun& run, const std::string& folder);
/// Draws sections.svg: sections at a few times, one above the other, the last at the bottom.
void plot_sections(const std::vector<WindSection>& sections, const std::string& folder);

}  // namespace aeolian
