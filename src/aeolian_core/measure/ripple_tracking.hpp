#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/measure/crest_tracks.hpp"
#include "aeolian_core/measure/ripple_shapes.hpp"

namespace aeolian {

/// How a crest has moved since the map before.
struct CrestMotion {
  int id = 0;            ///< of the crest, kept from map to map
  Figure speed;          ///< square to the crest, downwind positive [m/s]; NaN on the first map it is seen
  double direction = 0;  ///< of that motion, counter-clockwise from east [rad]
};

/// One map of a series.
struct TrackedMap {
  double time = 0;  ///< [s]
  RippleCrests found;
  RippleField field;
  std::vector<CrestMotion> motions;  ///< one for each crest
  /// Mean speed of the crests since the map before, by their lengths, and its scatter from crest to crest
  /// (standard deviation) [m/s].
  Figure celerity;
};

enum class RippleChange {
  merger,     ///< two crests become one
  split,      ///< one becomes two
  repulsion,  ///< two close, or touch for a while, and part again
  birth,      ///< a crest comes from nothing
  loss,       ///< a crest goes without a neighbour
  defect,     ///< an end of a crest has moved along the crests
};
const char* name_of(RippleChange change);

/// A change of the pattern, over a length of crest that may take a while to change.
struct RippleEvent {
  RippleChange kind = RippleChange::merger;
  double start = 0;  ///< [s]
  double end = 0;
  double time = 0;        ///< when half of it had changed [s]
  Eigen::Vector2d place;  ///< where, at that time [m]
  double length = 0;      ///< along the crests [m]
  /// Of repulsions: height of the crest downwind over that of the one upwind, when they close and when they
  /// have parted; NaN else. Sand has gone over when they differ.
  double ratio_before = 0;
  double ratio_after = 0;
};

/// An end of a crest over the maps in which it is seen.
struct DefectTrack {
  std::size_t first = 0;                ///< number of the first map
  std::vector<Eigen::Vector2d> places;  ///< [m]
  double travel = 0;                    ///< along the crests, to the left of the wind positive [m]
};

/// What a series of maps says.
struct RippleHistory {
  std::vector<TrackedMap> maps;
  std::vector<RippleEvent> events;  ///< by time
  std::vector<DefectTrack> defects;
  Figure celerity;  ///< mean over the maps, by their time, and its scatter from map to map [m/s]
};

/// Crests seen in parallel rows along the direction of a tracker.
struct TrackRow {
  struct Sample {
    double place = 0;         ///< downwind from the middle of the map [m]
    int crest = 0;            ///< in the map's crests
    std::size_t section = 0;  ///< nearest in that crest
  };
  std::vector<Sample> samples;  ///< by place
  double start = 0;             ///< what of the row is seen [m]
  double end = 0;
  std::vector<std::pair<double, double>> holes;
};

/// Follows ripples over maps of one grid. Each map is cut into rows along one direction, an eighth of a
/// wavelength apart, and the crests of every row are followed as in a series of profiles. Crest lines are the
/// same where most of their rows are; what changes in neighbouring rows at nearly the same place and time is
/// one event, if it takes in half a wavelength of crest. A crest that is missed in one map, or gone and back
/// within three, changes nothing, so that a flickering detection makes no events. Nothing is said within half
/// a wavelength of borders and holes.
///
/// Maps have to follow each other within the time in which ripples move by half a wavelength.
class RippleTracker {
 public:
  /// Direction into which the wind blows [rad]; ripples that keep within 60 degrees of it are seen. Throws
  /// Error when it is not finite or the grain diameter [m] is negative.
  explicit RippleTracker(double direction, double grain_diameter = 0);

  /// Takes the next map at a time [s]. Throws Error for another grid than that of the first map, or a time
  /// that is not later than the last.
  const RippleField& add(const GridGeometry& geometry, const HeightMap::Layer& elevation, double time);

  /// What has been seen so far.
  RippleHistory history() const;

 private:
  std::vector<CrestFrame> frames_of(std::size_t row) const;
  std::vector<TrackRow> cut(const RippleCrests& found) const;
  Eigen::Vector2d point(std::size_t row, double place) const;

  double direction_;
  double grain_diameter_;
  GridGeometry geometry_;
  HeightMap::Layer last_;                    ///< elevation
  std::vector<TrackedMap> maps_;             ///< crests and fields
  std::vector<double> shifts_;               ///< of the pattern along the rows since the map before [m]
  std::vector<std::vector<TrackRow>> rows_;  ///< of each map
  double row_spacing_ = 0;                   ///< [m]; 0 as long as no map had ripples
  std::size_t row_count_ = 0;
};

}  // namespace aeolian
