#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "aeolian_core/slide/piles/slide_site.hpp"

namespace aeolian {

/// What a newer map says of the pile that earlier events have left.
enum class PileNews {
  none,          ///< there was no pile
  seen,          ///< it is in the map
  unseen,        ///< the map shows the ground as it was before the pile
  contradicted,  ///< the map shows neither: somebody has cleared the snow away, or it lies otherwise
};

/// What an event on a map has left.
struct SitePile {
  int number = 0;          ///< of the event, from 1
  PileNews news{};         ///< of the pile before it
  double guessed = 0;      ///< share of the ground that the map does not show
  PileSize size;           ///< heights above the ground, lengths from the panel's middle
  double duration = 0;     ///< [s]
  bool still = false;      ///< whether the snow had come to rest
  double left_behind = 0;  ///< share of the slab's mass that stayed on the panel
  HeightMap patch;         ///< on the map's grid: `elevation`, `ground`, `variance`, see site_patch()
};

/// A moment of an event.
struct SiteMoment {
  int event;
  double time;        ///< since release [s]
  double fastest;     ///< [m/s]
  std::size_t awake;  ///< particles that move
};

/// Events at a panel on a map that changes between them.
///
/// The newest map is the ground. Under the pile it stays what it was before the pile, whether the map shows
/// the pile by now (because the patch was put into it, or a sensor has seen it) or not: particles carry the
/// pile and its compaction from event to event. A map that shows neither the pile nor the ground before it
/// contradicts the pile; then the particles are dropped, and what the map shows is ground.
class SitePiles {
 public:
  /// False ends the event.
  using Watch = std::function<bool(const SiteMoment&)>;

  virtual ~SitePiles() = default;
  /// A slab of some thickness [m] slides off. Nothing when the watch has ended it. Throws Error for what is
  /// not possible: no thickness, ground that is not known, a panel in the ground, a slab that is stuck. The
  /// pile then stays, unless the map contradicts it.
  virtual std::optional<SitePile> release(const HeightMap& map, double thickness,
                                          const Watch& watch = {}) = 0;
  /// The pile is no more.
  virtual void forget() = 0;
};

/// Throws Error for a scene that is not possible on any ground.
void check_apart_from_ground(const SlideScene& scene, int dimensions);

/// The scene's own ground is not used. Throws Error for dimensions other than 2 and 3, a model_error below 0
/// and for such a scene.
std::unique_ptr<SitePiles> make_site_piles(const SlideScene& scene, const SlideSite& site, int dimensions,
                                           double model_error);

}  // namespace aeolian
