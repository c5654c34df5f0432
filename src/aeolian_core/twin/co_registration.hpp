#pragma once

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// What a surface may be moved by before it is compared.
enum class CoRegistration {
  shift,  ///< east, north and up
  plane,  ///< up, and tilted two ways: nothing moves sideways
  rigid   ///< all of these, and turned about the vertical
};

/// A surface laid onto another, and what was done to it, with standard errors.
struct CoRegistered {
  HeightMap map;           ///< on the grid of the other: elevation, variance when it has one
  Figure east, north, up;  ///< moved by, in the middle of the map [m]
  Figure tilt_east;        ///< slope added: height per metre eastwards
  Figure tilt_north;       ///< and northwards
  Figure turn;             ///< about the middle, counter-clockwise [rad]
  int held = 0;            ///< of two, horizontal directions in which the relief holds the surface
  std::size_t cells = 0;   ///< that it rests on
  double nmad_before = 0;  ///< of the differences in them [m]
  double nmad_after = 0;
};

/// Moves `a` onto the elevation of `b` so that the differences are least: the linearised problem of Nuth &
/// Kaab (2011, The Cryosphere 5, 271-290), solved by Gauss-Newton from maps averaged over 8, 4, 2 cells
/// (Huber's weights, 1.345 robust standard deviations) to the full ones (Tukey's biweight, 4.685: what
/// changed has no say). Angles are taken as small. Standard errors hold for neighbours that err alike within
/// blocks of 32 cells (sums of scores over blocks: Liang & Zeger 1986).
///
/// What moved between the surfaces must not be taken for misalignment: with `stable` (a value above 0.5 in a
/// cell of b's grid) only ground that did not change counts. Without, a shift removes the migration that all
/// ripples have in common; a plane does not. The misalignment must be smaller than a quarter of the shortest
/// dominant wavelength. Directions in which the surface rises and falls by no more than its noise does are
/// not held: it is not moved there.
///
/// Throws Error when a point would move by more than `max_shift` [m], sideways or up, for fewer than 100
/// cells known in both, and for steps that do not settle.
CoRegistered co_register(const HeightMap& a, const HeightMap& b, CoRegistration method, double max_shift,
                         const HeightMap::Layer* stable);

}  // namespace aeolian
