#pragma once

#include <memory>
#include <vector>

#include "aeolian_core/wind/mass_consistent_wind.hpp"
#include "aeolian_core/wind/spectral_volume.hpp"
#include "aeolian_core/wind/sph/sph_volume.hpp"
#include "aeolian_core/wind/sph/thesis_volume.hpp"
#include "aeolian_core/wind/wind_model.hpp"

namespace aeolian {

/// Models of the wind over relief. The air of particles and the thesis' are never chosen, only asked for.
enum class WindBackend { log_law, spectral, mass_consistent, sph, thesis_compatible };
/// As a WindField tells it: "log law", "spectral", "mass consistent", "SPH", "thesis
/// compatible".
std::string name_of(WindBackend backend);
/// The one that a flag or parameter names: log, spectral, mass_consistent, sph,
/// thesis_compatible; nothing for any other word.
std::optional<WindBackend> backend_of(const std::string& word);

/// What is wanted of a wind.
enum class WindQuestion { surface_stress, velocities };

/// The model for a relief: the log law where slopes stay below 0.01 (relief shorter than what the settings
/// take for ground is none), linear theory where what is outside of separated air is at most 0.3 steep, or
/// 0.4 for the stress, of which the mass-consistent wind has the place wrong, and that beyond.
WindBackend choose_backend(const WindRelief& relief, double direction, const ReliefSettings& settings,
                           WindQuestion question);

struct TerrainWindSettings {
  ReliefSettings relief;
  std::optional<WindBackend> backend;  ///< chosen when there is none
  /// Directions within a sector share a solution, that of its middle [rad]; zero solves each.
  double sector = M_PI / 18;
  /// Part of the relief's slopes (their squares' sum) that may change before they are solved anew.
  double change = 0.01;
  MassConsistentVolume::Settings volume;
  SphSettings sph;
  ThesisVolumeSettings thesis;
};

/// The wind at the surface of a map, by the model that suits its relief. Solved once for each sector of
/// directions, then scaled, as the answer of relief to a neutral wind does not depend on its speed; solved
/// anew when relief has changed enough.
///
///     TerrainWind model(settings);
///     WindField field = model.solve({8.0, direction, 2.0}, &map);
class TerrainWind : public WindModel {
 public:
  /// Throws Error for settings that are not allowed.
  explicit TerrainWind(const TerrainWindSettings& settings);
  ~TerrainWind() override;

  /// Without a map: the log law. Throws Error for a reading that is not physical, and with the reason for one
  /// of an anemometer that stands beside the map, in its roughness or in separated air.
  WindField solve(const WindInput& input, const HeightMap* surface) override;
  /// Of several anemometers at one time: the mean of the surroundings that each of them tells.
  WindField solve(const std::vector<WindInput>& inputs, const HeightMap* surface);

  /// The wind in the air over a map, for a wind of the surroundings that blows to `direction` [rad], in units
  /// of their friction velocity: up to `top` over the ground [m]. Null where the model is the log law.
  std::unique_ptr<WindVolume> volume(const HeightMap& surface, double direction, double top) const;

  /// How many solutions were made so far.
  int solutions() const { return solutions_; }

 private:
  struct Solution;
  struct Surroundings {
    double friction_velocity;
    double direction;
  };
  void watch(const HeightMap& surface, double time);
  Solution& solution(const HeightMap& surface, double direction);
  Surroundings surroundings(const WindInput& input, const HeightMap* surface);
  const AirVelocity& at_anemometer(Solution& solution, const HeightMap& surface, const WindInput& input);

  TerrainWindSettings settings_;
  WindRelief relief_;           ///< that was solved for
  HeightMap::Layer elevation_;  ///< that was seen last
  double since_ = 0;            ///< when the relief was taken [s]
  std::vector<std::unique_ptr<Solution>> solved_;
  int solutions_ = 0;
};

}  // namespace aeolian
