#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "aeolian_core/measure/profile_analysis.hpp"

namespace aeolian {

/// The crests of one photograph of a series, or of one row of a map, and what is known of its pattern.
struct CrestFrame {
  std::vector<double> crests;  ///< positions, rising [m]
  double time = 0;             ///< [s]
  double shift = 0;            ///< of the pattern since the frame before [m]
  double wavelength = 0;       ///< [m]
  double start = 0;            ///< the section [m]
  double end = 0;
  std::vector<std::pair<double, double>> holes;  ///< parts of it in which nothing is seen [m]
};

/// One crest over the frames in which it is seen. Where it begins or ends within the section, an event says
/// how; nothing is said at the first and last frame, at the ends of the section and at holes.
struct CrestTrack {
  std::size_t first = 0;    ///< frame in which it appears
  std::vector<int> crests;  ///< its number in each frame from there, -1 where it was missed
  std::optional<ProfileSeries::Event> beginning;  ///< split or birth
  std::optional<ProfileSeries::Event> ending;     ///< merger or loss
  std::size_t last() const { return first + crests.size() - 1; }
};

/// Follows crests from frame to frame; a crest missed in one frame may come back, one seen in a single frame
/// between others is left out.
std::vector<CrestTrack> follow_crests(const std::vector<CrestFrame>& frames);

/// Where the number of crests changes, in the order of time. See analyse_series.
std::vector<ProfileSeries::Event> crest_events(const std::vector<CrestFrame>& frames);

}  // namespace aeolian
