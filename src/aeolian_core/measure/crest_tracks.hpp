#pragma once

#include <vector>

#include "aeolian_core/measure/profile_analysis.hpp"

namespace aeolian {

/// The crests of one photograph of a series and what is known of its pattern.
struct CrestFrame {
  std::vector<double> crests;  ///< positions [m]
  double time = 0;             ///< [s]
  double shift = 0;            ///< of the pattern since the frame before [m]
  double wavelength = 0;       ///< [m]
  double start = 0;            ///< the section [m]
  double end = 0;
};

/// Follows crests from frame to frame and tells where their number changes, in the order of time. See
/// analyse_series.
std::vector<ProfileSeries::Event> crest_events(const std::vector<CrestFrame>& frames);

}  // namespace aeolian
