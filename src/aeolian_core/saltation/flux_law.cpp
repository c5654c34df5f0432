#include "aeolian_core/saltation/flux_law.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// u*^2 - u*_it^2 of one of the points of a fit.
double excess(double threshold, double friction_velocity) {
  const double result = friction_velocity * friction_velocity - threshold * threshold;
  if (!(threshold > 0 && result > 0))
    throw Error("flux law: the friction velocity is " + std::to_string(friction_velocity) +
                " m/s, must be above the threshold, " + std::to_string(threshold) + " m/s");
  return result;
}

struct Line {
  double offset, slope;
};

Line line_through(const std::vector<double>& x, const std::vector<double>& y,
                  const std::vector<double>& weight) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    n += weight[i];
    sx += weight[i] * x[i];
    sy += weight[i] * y[i];
    sxx += weight[i] * x[i] * x[i];
    sxy += weight[i] * x[i] * y[i];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {(sy - slope * sx) / n, slope};
}

void require_points(const std::vector<double>& friction_velocity, const std::vector<double>& flux) {
  if (flux.size() < 2 || flux.size() != friction_velocity.size())
    throw Error("flux law: " + std::to_string(flux.size()) + " fluxes at " +
                std::to_string(friction_velocity.size()) +
                " friction velocities, must be two or more of both");
}

}  // namespace

FluxLaw FluxLaw::fit(double threshold, const std::vector<double>& friction_velocity,
                     const std::vector<double>& flux) {
  require_points(friction_velocity, flux);
  std::vector<double> x, y, weight;
  for (std::size_t i = 0; i < flux.size(); ++i) {
    x.push_back(friction_velocity[i] / threshold - 1);
    y.push_back(flux[i] / excess(threshold, friction_velocity[i]));
    weight.push_back(1 / (y.back() * y.back()));
  }
  const Line line = line_through(x, y, weight);
  return {threshold, line.offset, line.slope / line.offset};
}

double excess_stress_exponent(double threshold, const std::vector<double>& friction_velocity,
                              const std::vector<double>& flux) {
  require_points(friction_velocity, flux);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < flux.size(); ++i) {
    x.push_back(std::log(excess(threshold, friction_velocity[i])));
    y.push_back(std::log(flux[i]));
  }
  return line_through(x, y, std::vector<double>(x.size(), 1)).slope;
}

}  // namespace aeolian
