#include "aeolian_core/bedforms/bed_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"forcing"};

}  // namespace

double Forcing::erosion_rate() const {
  const double side = grain.effective_diameter();
  return ejection_rate * side * side * side;
}

void check(const Forcing& forcing, double duration) {
  check(forcing.grain);
  require(std::isfinite(forcing.direction), "direction", forcing.direction, "finite");
  require(forcing.friction_velocity >= 0 && std::isfinite(forcing.friction_velocity), "friction velocity",
          forcing.friction_velocity, "zero or more and finite");
  require(forcing.impact_angle_spread >= 0 && forcing.impact_angle_spread <= 1, "spread of impact angles",
          forcing.impact_angle_spread, "0 to 1 rad");
  require(forcing.impact_angle >= 0.02 && forcing.impact_angle <= 1.4, "impact angle", forcing.impact_angle,
          "0.02 to 1.4 rad");
  require(forcing.ejection_rate >= 0 && std::isfinite(forcing.ejection_rate), "ejection rate",
          forcing.ejection_rate, "zero or more and finite");
  require(forcing.reptation_length >= 0 && std::isfinite(forcing.reptation_length), "reptation length",
          forcing.reptation_length, "zero or more and finite");
  require(duration >= 0 && std::isfinite(duration), "duration", duration, "zero or more and finite");
}

Forcing make_forcing(const SaltationState& state, double direction, const Grain& grain,
                     const MeanSplash& splash) {
  Forcing forcing;
  forcing.direction = direction;
  forcing.friction_velocity = state.friction_velocity;
  forcing.impact_angle = state.impact_angle;
  forcing.impact_angle_spread = state.impact_angle_spread;
  forcing.ejection_rate = state.impact_rate * splash.ejecta_per_impact(grain, state.impact_speed);
  forcing.reptation_length = splash.reptation_length(grain);
  forcing.grain = grain;
  return forcing;
}

Forcing mean_forcing(const std::vector<Forcing>& forcings, const std::vector<double>& weights) {
  if (forcings.empty()) throw Error("forcing: there is nothing to average");
  if (forcings.size() != weights.size())
    throw Error("forcing: " + std::to_string(weights.size()) + " weights for " +
                std::to_string(forcings.size()) + " forcings, must be one for each");
  double time = 0;
  for (const double weight : weights) {
    require(weight >= 0 && std::isfinite(weight), "weight", weight, "zero or more and finite");
    time += weight;
  }
  require(time > 0, "sum of weights", time, "positive");

  double ejections = 0;
  double east = 0;
  double north = 0;
  double friction = 0;
  double angle = 0;
  double angle_square = 0;
  double length = 0;
  for (std::size_t i = 0; i < forcings.size(); ++i) {
    const double n = weights[i] * forcings[i].ejection_rate;
    ejections += n;
    east += n * std::cos(forcings[i].direction);
    north += n * std::sin(forcings[i].direction);
    friction += n * forcings[i].friction_velocity;
    angle += n * forcings[i].impact_angle;
    angle_square +=
        n * (std::pow(forcings[i].impact_angle, 2) + std::pow(forcings[i].impact_angle_spread, 2));
    length += n * forcings[i].reptation_length;
  }
  Forcing mean = forcings.front();
  mean.ejection_rate = ejections / time;
  if (ejections > 0) {
    mean.direction = std::atan2(north, east);
    mean.friction_velocity = friction / ejections;
    mean.impact_angle = angle / ejections;
    mean.impact_angle_spread =
        std::sqrt(std::max(0.0, angle_square / ejections - std::pow(mean.impact_angle, 2)));
    mean.reptation_length = length / ejections;
  }
  return mean;
}

TileMask changed_tiles(const GridGeometry& g, const std::vector<double>& before,
                       const std::vector<double>& after) {
  TileMask result(g);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      if (before[g.index(x, y)] != after[g.index(x, y)]) result.activate(x, y);
  return result;
}

}  // namespace aeolian
