#pragma once

#include <vector>

#include "aeolian_core/bedforms/theory/triangular_ripple.hpp"

namespace aeolian {

/// A smaller, faster ripple runs into a larger one, without fluctuations (Werner 1987, sec. V; differential
/// equations reconstructed in specification sec. 4). Both are triangles of the same angles; heights are in
/// units of any length, and the angles drop out.

/// Two ripples, one downwind of the other.
struct RipplePair {
  double upstream;    ///< height of its crest
  double downstream;  ///< height of its crest
  double overlap;     ///< height at which the lee of the first meets the stoss of the second; 0: they touch

  /// Height of the first crest above that meeting, the relief that is left between the two.
  double effective_height() const { return upstream - overlap; }
  /// u1^2 + u2^2 - w^2: the cross-section of the sand in both, constant up to a factor of the angles.
  double sand() const { return upstream * upstream + downstream * downstream - overlap * overlap; }
};

/// The course of a collision from touching to touching again; the pair has then passed sizes, not places.
struct Collision {
  std::vector<RipplePair> course;
  RipplePair before() const { return course.front(); }
  RipplePair after() const { return course.back(); }
  /// Least effective height on the way, in parts of the height of the smaller ripple.
  double least_effective_height() const;
};

/// Collides an upstream ripple of height `ratio` with one of height 1. Target ejection exchanges the sizes,
/// brink ejection leaves them closer to each other; without fluctuations the two never merge. Throws Error
/// when the ratio is not from 0.05 to below 1: an upstream ripple that is not smaller never catches up.
Collision collide(double ratio, EjectionLaw ejection);

}  // namespace aeolian
