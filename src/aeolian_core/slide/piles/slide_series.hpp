#pragma once

#include <functional>

#include "aeolian_core/slide/piles/slide_scene.hpp"

namespace aeolian {

/// What an event has left.
template <int Dim>
struct SlideEvent {
  int number = 0;                        ///< from 1; STEP of the thesis is one less
  PileSize pile;                         ///< heights above the ground
  std::vector<MaterialPoint<Dim>> snow;  ///< pile and what lies beside it
  double duration = 0;                   ///< [s]
  bool still = false;                    ///< whether the snow had come to rest, or the time was over
  double mass = 0;                       ///< of `snow` [kg], in two dimensions per metre
  double left_behind = 0;                ///< mass that stayed on the panel, and is cleared off it [kg]
  double density = 0;                    ///< of the pile: mass over the volume of its particles [kg/m^3]
  double fastest = 0;                    ///< speed in the whole event [m/s]
  MpmWork work;
};

/// A moment of an event, to look at.
template <int Dim>
struct SlideMoment {
  int event;
  double time;  ///< since release [s]
  const MaterialPoints<Dim>& snow;
};

/// Events one after another: a slab on the panel, its release, fall and rest, the next one on top
/// (Frischholz, section 3.3 of the specification).
template <int Dim>
class SlideSeries {
 public:
  /// Is shown the snow now and then (24 times a second); false ends the event and the series.
  using Watch = std::function<bool(const SlideMoment<Dim>&)>;

  /// Throws Error for a scene that is not possible.
  explicit SlideSeries(const SlideScene& scene);

  /// The next event; nothing when the watch has ended it. Throws Error when the slab does not slide.
  std::optional<SlideEvent<Dim>> next(const Watch& watch = {});

  /// Goes on with another scene: what was changed holds from the next event on, the pile stays. Throws Error
  /// for one that is not possible; the old one then stays.
  void go_on(const SlideScene& scene);
  /// The pile is gone: taken away, or part of the scene's ground.
  void drop_pile() { pile_.clear(); }

  const SlideScene& scene() const { return scene_; }
  const std::vector<MaterialPoint<Dim>>& pile() const { return pile_; }

 private:
  std::vector<MaterialPoint<Dim>> carried_over(const std::vector<MaterialPoint<Dim>>& snow) const;

  SlideScene scene_;
  std::vector<MaterialPoint<Dim>> pile_;
  int events_ = 0;
};

/// Whether a place is on the panel: over it and less than three slabs out of it.
template <int Dim>
bool on_panel(const SlideScene& scene, const Point<Dim>& place);

/// The pile's surface as a map of the given cells: `elevation` is the top of the snow, `ground` what it lies
/// on, `variance` what particles and cells leave open. Two dimensions give one row at y = 0.
template <int Dim>
HeightMap pile_map(const SlideScene& scene, const std::vector<MaterialPoint<Dim>>& snow, double cell);

extern template class SlideSeries<2>;
extern template class SlideSeries<3>;

}  // namespace aeolian
