#pragma once

#include "aeolian_core/slide/piles/slide_scene.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Where a slide happens in a map: below its origin, the middle of the panel's surface, and along its x axis.
/// Heights are those of the map.
struct SlideSite {
  double x = 0;          ///< of the panel's middle [m]
  double y = 0;          ///< the same
  double direction = 0;  ///< where snow slides to, counter-clockwise from east [rad]

  Point<2> to_map(const Point<2>& slide) const;
  Point<2> to_slide(const Point<2>& map) const;
};

/// The ground of a slide as a map of the slide's own axes.
struct SiteGround {
  /// On cells as large as the solver's, in two dimensions one row: `elevation`, and its `variance` (0 where
  /// the map has none).
  HeightMap map;
  double guessed{};  ///< share of the cells that were filled from those about them
};

/// What the map shows is panel rather than ground: within the panel's outline and above its lower face.
bool hidden_by_panel(const SlideScene& scene, const Point<2>& slide, double elevation);

/// Takes the ground out of a map: from behind the panel to where a block would land that has slid down all of
/// the panel, and half a panel further. What the panel hides is filled from the ground about it, so is what
/// is unknown. Throws Error when more than `most_unknown` of what the panel does not hide is unknown, or lies
/// outside the map.
SiteGround ground_of_site(const HeightMap& map, const SlideScene& scene, const SlideSite& site,
                          int dimensions, double most_unknown = 0.1);

/// A pile (pile_map() in the slide's axes, on its cells) that lies on `bare` ground (of ground_of_site) as a
/// patch of a map: cells of the map that carry at least half a cell of snow have elevation, ground and
/// variance, others, and those that show the panel, are unknown. In two dimensions the pile is as wide as the
/// slab. To the variance of pile_map() come that of the ground and the square of `model_error` times the
/// depth.
HeightMap site_patch(const HeightMap& map, const SlideScene& scene, const SlideSite& site,
                     const HeightMap& pile, const HeightMap& bare, int dimensions, double model_error);

}  // namespace aeolian
