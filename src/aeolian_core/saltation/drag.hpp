#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/atmosphere.hpp"
#include "aeolian_core/saltation/octave_table.hpp"

namespace aeolian {

enum class DragLaw {
  sphere,  ///< c_d = 24 / Re + 6 / (1 + sqrt(Re)) + 0.4 (White 1974; Werner 1987, eq. 4.31)
  sand,    ///< c_d = ((32 / Re)^(2/3) + 1)^1.5, natural grains (Cheng 1997)
};

/// For a positive Reynolds number of the diameter.
double drag_coefficient(DragLaw law, double reynolds);

/// Speed of a steady fall through still air without buoyancy [m/s], to rounding.
double terminal_speed(DragLaw law, const Grain& grain, const Atmosphere& atmosphere);

/// How fast air takes a grain along: acceleration = rate x (air's velocity - grain's), both components with
/// the whole relative speed (Werner 1987, eq. 4.30). A table of the square of that speed, good to 3e-5.
class Drag {
 public:
  static constexpr double least = 0x1p-30;  ///< square of speed below which the rate is constant [m^2/s^2]
  static constexpr double most = 0x1p16 - 0x1p-30;

  /// `scale` multiplies the force: 1, or 0.62 to agree with the results printed in the thesis.
  Drag(DragLaw law, const Grain& grain, const Atmosphere& atmosphere, double scale);

  /// [1/s] at a square of relative speed [m^2/s^2] from `least` to `most`.
  double rate(double speed_squared) const { return table_(speed_squared); }
  OctaveTable<5>::View view() const { return table_.view(); }

 private:
  OctaveTable<5> table_;
};

}  // namespace aeolian
