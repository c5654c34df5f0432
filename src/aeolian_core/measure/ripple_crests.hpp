#pragma once

#include <vector>

#include <Eigen/Core>

#include "aeolian_core/measure/ripple_relief.hpp"

namespace aeolian {

/// The ripple under one point of a crest, in the vertical plane square to the crest; NaN where its troughs or
/// the next crest are not seen. Slopes and heights are above the bed without its ripples.
struct CrestSection {
  float height = 0;        ///< over the line between its troughs [m]
  float spacing = 0;       ///< to the next crest downwind [m]
  float stoss_length = 0;  ///< from the trough upwind [m]
  float lee_length = 0;    ///< to the trough downwind [m]
  float stoss_mean = 0;    ///< slopes, positive [rad]
  float stoss_max = 0;     ///< over a tenth of a wavelength [rad]
  float lee_mean = 0;
  float lee_max = 0;
  float turn = 0;  ///< of the crest's own normal against the pattern's, to the left positive [rad]
};

enum class CrestEnd {
  unseen,       ///< at the map's border or a hole: nothing is known of it
  termination,  ///< it sinks into a trough
  junction,     ///< it runs into a neighbouring crest
};

/// One crest.
struct CrestLine {
  std::vector<Eigen::Vector2d> points;  ///< in the map frame, some cell apart, to the left of the wind [m]
  std::vector<CrestSection> sections;   ///< one for each point
  double length = 0;                    ///< [m]
  double height = 0;                    ///< median of the sections [m]; NaN when none is seen
  CrestEnd right = CrestEnd::unseen;    ///< of the first point
  CrestEnd left = CrestEnd::unseen;     ///< of the last
};

/// A place where the pattern has one crest more on one side than on the other (a dislocation).
struct RippleDefect {
  Eigen::Vector2d place;  ///< [m]
  CrestEnd kind = CrestEnd::termination;
  bool opens_left = false;  ///< the additional crest is to the left of the wind
};

/// The crests of a map.
struct RippleCrests {
  RippleRelief relief;
  std::vector<CrestLine> crests;
  std::vector<RippleDefect> defects;
  double searched_area = 0;  ///< in which an end of a crest would be seen as a defect [m^2]
};

/// Finds the crests of a map by their maxima along rows square to the pattern, which are followed from row to
/// row. Empty for a map whose ripples cannot be told from noise.
///
/// A crest counts where both its flanks fall by more than four standard deviations of the noise (as
/// smoothed), a twelfth of the typical relief and half a grain diameter [m], and on half of its length by
/// half as much again; shorter ones than half a wavelength do not. Gaps of up to 0.4 wavelengths are bridged,
/// and ends that face each other within half a wavelength (sideways a quarter). Crests may turn from the
/// pattern by up to 60 degrees, the pattern from `direction` by as much. Where the map ends or has a hole
/// within 0.6 wavelengths the end of a crest is not taken for a defect. Throws Error as ripple_relief does.
RippleCrests find_crests(const GridGeometry& geometry, const HeightMap::Layer& elevation, double direction,
                         double grain_diameter = 0);

}  // namespace aeolian
