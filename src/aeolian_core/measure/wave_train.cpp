#include "aeolian_core/measure/wave_train.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "aeolian_core/surface/golden_section.hpp"

namespace aeolian {
namespace {

constexpr int unknowns = 6;           // line, wave and overtone
constexpr double fewest_waves = 1.2;  // in a profile
constexpr double equally_good = 1.1;  // sums of squares

struct TrainFit {
  double cost = 0;   // sum of squared residuals [m^2]
  double slope = 0;  // of the line
  Eigen::VectorXd residuals;
};

TrainFit fit(const Eigen::VectorXd& z, double step, double wavelength) {
  const auto n = z.size();
  Eigen::MatrixXd design(n, unknowns);
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = (static_cast<double>(i) - middle) * step;
    const double phase = 2 * M_PI * x / wavelength;
    design.row(i) << 1, x, std::cos(phase), std::sin(phase), std::cos(2 * phase), std::sin(2 * phase);
  }
  const Eigen::Matrix<double, unknowns, unknowns> normal = design.transpose() * design;
  const Eigen::Matrix<double, unknowns, 1> solution = normal.ldlt().solve(design.transpose() * z);
  TrainFit result;
  result.residuals = z - design * solution;
  result.cost = result.residuals.squaredNorm();
  result.slope = solution[1];
  return result;
}

/// How many samples count for one: neighbours' residuals are alike up to the first lag at which they are not.
double samples_per_independent(const Eigen::VectorXd& residuals) {
  const auto n = residuals.size();
  const double variance = residuals.squaredNorm();
  double sum = 1;
  for (Eigen::Index lag = 1; lag < n / 4; ++lag) {
    const double likeness = residuals.head(n - lag).dot(residuals.tail(n - lag)) / variance;
    if (!(likeness > 0.05)) break;
    sum += 2 * likeness;
  }
  return sum;
}

}  // namespace

Figure train_wavelength(const EvenProfile& profile, double shortest, double longest) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd z =
      Eigen::Map<const Eigen::VectorXd>(profile.z.data(), static_cast<Eigen::Index>(profile.z.size()));
  const double length = static_cast<double>(z.size()) * profile.step;
  longest = std::min(longest, length / fewest_waves);
  if (!(shortest > 0) || !(longest >= shortest) || z.size() < 4 * unknowns) return {none, none};

  const auto cost = [&](double log_wavelength) {
    return fit(z, profile.step, std::exp(log_wavelength)).cost;
  };
  // Steps that move the ends of the train by a tenth of a wave are fine enough to find the valleys.
  std::vector<double> tried;
  std::vector<double> costs;
  for (double wavelength = shortest; wavelength <= longest; wavelength *= 1 + 0.1 * wavelength / length) {
    tried.push_back(std::log(wavelength));
    costs.push_back(cost(tried.back()));
  }
  const double least = *std::min_element(costs.begin(), costs.end());
  std::size_t at = 0;
  while (costs[at] > equally_good * least) ++at;
  while (at + 1 < costs.size() && costs[at + 1] < costs[at]) ++at;
  const double step = std::log1p(0.1 * std::exp(tried[at]) / length);
  const double best = minimum_between(tried[at] - step, tried[at] + step, 1e-6 * step, cost);

  const TrainFit train = fit(z, profile.step, std::exp(best));
  const double h = step / 20;
  const double curvature = (cost(best + h) - 2 * train.cost + cost(best - h)) / (h * h);
  const double variance = train.cost / static_cast<double>(z.size() - unknowns - 1);
  const double wavelength = std::exp(best) * std::hypot(1, train.slope);
  if (!(curvature > 0)) return {wavelength, none};
  return {wavelength,
          wavelength * std::sqrt(2 * variance * samples_per_independent(train.residuals) / curvature)};
}

}  // namespace aeolian
