#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/twin/twin_physics.hpp"
#include "aeolian_core/twin/uncertain_parameters.hpp"
#include "aeolian_core/twin/wind_course.hpp"

namespace aeolian {

namespace layer {
inline const std::string spread = "spread";  ///< standard deviation of a predicted elevation [m]
}  // namespace layer

/// What a member of an ensemble predicts.
struct MemberForecast {
  UncertainParameters parameters;
  std::vector<HeightMap::Layer> elevation;  ///< for each horizon, on the members' grid [m]
};

struct EnsembleForecast {
  /// For each horizon: elevation (the best single guess of the surface), spread (of the error of that guess),
  /// initial, lead_time; on the grid of the start.
  std::vector<Forecast> forecasts;
  GridGeometry member_geometry;
  std::vector<MemberForecast> members;
};

/// Several forecasts from one measured map, which differ in what is not known: the map's own error (layer
/// `variance`), the wind and the parameters of the model.
///
/// `elevation` is the run with the median parameters on the map as it is, at full resolution: a mean over
/// members would flatten crests that they put at different places. Members run on cells of the largest
/// multiple of the map's that is not above `member_cell`. Their scatter, the model's own error and what
/// nobody knows of what comes over open borders make up `spread`.
class ForecastEnsemble {
 public:
  struct Settings {
    double member_cell = 0;          ///< members run on cells of up to this; 0: as the map [m]
    double map_error_length = 0.02;  ///< over which errors of the map are alike [m]
    /// Standard deviation of a member's wind, a share of friction velocity: that the mean of a minute is not
    /// that of the minutes that follow (7 % where gusts of 8 s vary by 12 %).
    double wind_error = 0.08;
    double direction_error = 0.05;    ///< [rad]
    double model_error_speed = 1e-5;  ///< growth of the model's own error, calibrated [m/sqrt(s)]
    std::uint64_t seed = 1;
  };

  /// Throws Error naming a setting outside its range.
  ForecastEnsemble(TwinPhysics physics, const Settings& settings);

  /// Runs all members to each horizon. No member: the plain forecast without the layer `spread`. Bits do not
  /// depend on the number of threads. Throws Error as make_forecasts does.
  EnsembleForecast run(const HeightMap& start, const std::vector<WindSpell>& wind,
                       const std::vector<double>& horizons, const std::vector<UncertainParameters>& members,
                       const UncertainParameters& median) const;

 private:
  struct Disturbance;
  Disturbance disturbance(std::uint64_t forecast, std::size_t member) const;
  std::vector<ForcingSpell> forcings(const std::vector<WindSpell>& wind,
                                     const UncertainParameters& parameters) const;
  HeightMap disturbed(const HeightMap& start, std::uint64_t forecast, std::size_t member) const;

  TwinPhysics physics_;
  Settings settings_;
};

}  // namespace aeolian
