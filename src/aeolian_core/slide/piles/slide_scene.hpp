#pragma once

#include <optional>

#include "aeolian_core/slide/mpm/material_points.hpp"
#include "aeolian_core/slide/piles/pile_measure.hpp"

namespace aeolian {

/// A tilted panel with a slab of snow on it, and the ground below. The panel's centre is above the origin,
/// snow slides towards x. In two dimensions all is per metre of width. Made like this: the laboratory's at 40
/// degrees (Frischholz, tables 2.3.1 and 3.4.1).
struct SlideScene {
  enum class HeightOf { centre, lower_edge };
  /// What becomes of the pile between events.
  enum class Between {
    keep,    ///< particles keep place, elastic state and compaction
    reseed,  ///< the thesis': fresh particles in the cells that hold snow, of the same mass in all
  };

  SnowLaw snow;
  double panel_length = 0.245;  ///< along the slope, and that of the slab [m]
  double panel_width = 0.213;   ///< [m]
  double tilt = 0.69813170;     ///< below the horizontal [rad]
  double panel_height = 0.33;   ///< above the ground [m]
  HeightOf height_of = HeightOf::centre;
  double panel_friction = 0.7;
  double slab_thickness = 0.02;  ///< normal to the panel [m]
  double slab_width = 0.142;     ///< [m]

  double cell = 0.005;            ///< [m]
  double particles_per_cell = 4;  ///< 6 or more in three dimensions
  double jitter = 0.2;            ///< of the particles' spacing
  Transfer transfer = Transfer::apic;
  Between between = Between::keep;
  std::uint64_t seed = 1;
  int threads = 0;
  double still = 0.02;      ///< an event is over when no particle has been faster [m/s] ...
  double still_for = 0.25;  ///< ... for so long [s]
  double longest = 6;       ///< that an event may take [s]
  double stuck_after = 1;   ///< a slab that has not left by then and does not move is stuck [s]

  /// Takes the layer `elevation`; without a map the ground is level.
  std::optional<HeightMap> ground;

  double lower_edge() const;  ///< height of the panel's lower edge above z = 0 [m]
  PileRules rules() const;    ///< to measure its piles by
};

/// Throws Error naming what is not possible: no thickness, a panel in the ground, ...
void check(const SlideScene& scene, int dimensions);

/// The panel's surface: its centre, and unit vectors down the slope, (across,) and out of it.
template <int Dim>
struct PanelFrame {
  Point<Dim> centre;
  Eigen::Matrix<double, Dim, Dim> axes;
};
template <int Dim>
PanelFrame<Dim> panel_frame(const SlideScene& scene);

/// Of the panel [m]: so thick that no snow goes through it.
double panel_thickness(const SlideScene& scene);

/// Panel and ground.
template <int Dim>
std::vector<Obstacle<Dim>> obstacles_of(const SlideScene& scene);

/// Fresh snow on the panel.
template <int Dim>
std::vector<MaterialPoint<Dim>> slab_of(const SlideScene& scene, int event);

}  // namespace aeolian
