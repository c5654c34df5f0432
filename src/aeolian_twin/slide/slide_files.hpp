#pragma once

#include <string>
#include <vector>

#include "aeolian_core/slide/piles/slide_series.hpp"
#include "aeolian_twin/slide/slide_config.hpp"

namespace aeolian {

/// An event with what its pictures need.
template <int Dim>
struct KeptEvent {
  SlideEvent<Dim> event;
  std::vector<MaterialPoint<Dim>> in_motion;  ///< when snow was fastest
  double motion_time = 0;                     ///< [s]
  double seconds = 0;                         ///< that the computer took
};

/// Writes events.csv, a row an event, and events.yaml: the same with the scene, and the command.
template <int Dim>
void write_events(const SlideConfig& config, const std::vector<KeptEvent<Dim>>& events,
                  const std::string& command, const std::string& folder);

/// Writes the state of the snow after an event as particles_NN.csv, and its surface as pile_NN.tif with bands
/// elevation, ground and variance; in two dimensions pile_NN.csv.
template <int Dim>
void write_snow(const SlideConfig& config, const SlideEvent<Dim>& event, const std::string& folder);

/// Draws event_NN.png: the snow in motion, by speed, and at rest, by p0.
template <int Dim>
void draw_event(const SlideConfig& config, const KeptEvent<Dim>& event, const std::string& folder);

/// Draws profiles.svg: the pile along its middle after each event; and growth.svg: height and length by
/// event.
template <int Dim>
void plot_piles(const SlideConfig& config, const std::vector<KeptEvent<Dim>>& events,
                const std::string& folder);

}  // namespace aeolian
