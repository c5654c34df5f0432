#pragma once

#include <memory>
#include <optional>
#include <string>

#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"
#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_twin/erosion/terrain.hpp"

namespace aeolian {

/// What the program `blow_surface` blows over: ground, cover, wind and time. config/scenes has some.
struct ErosionScene {
  std::string terrain = "flat";
  double length = 1.28, width = 1.28, cell = 0.005;  ///< [m]
  LooseCover cover;
  bool snow = false;
  double wind_speed = 10, wind_height = 10;  ///< [m/s], [m]
  double direction = 0;                      ///< where the wind blows to, counter-clockwise from east [rad]
  /// Seconds after which the wind is solved anew over the surface, hard ground and drifts; zero: a log law
  /// that does not know them.
  double terrain_wind = 0;
  double minutes = 5;
  std::string model = "particles";  ///< or hop_table, thesis_compatible
  ErosionParameters parameters;
  std::string expected;  ///< what field papers report, in one line

  Grain grain() const;
  WindField wind() const;
  /// The model of the wind over the surface.
  std::unique_ptr<WindModel> wind_model() const;
  WindInput wind_input() const;
  /// With the model's name put into effect.
  ErosionParameters chosen_parameters(std::uint64_t seed) const;
};

/// Reads a scene strictly; throws Error naming file, line and key. Temperature and the like are for snow
/// only.
ErosionScene read_erosion_scene(const std::string& path);

/// Sand or snow with what belongs to it: roughness, air, bonds. Throws Error for another material.
void set_material(ErosionScene& scene, const std::string& material);

/// Speed and height [m] of "12@10"; throws Error for anything else.
void set_wind(ErosionScene& scene, const std::string& text);

}  // namespace aeolian
