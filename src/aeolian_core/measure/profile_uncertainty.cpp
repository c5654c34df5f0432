#include "aeolian_core/measure/profile_uncertainty.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Dense>

namespace aeolian {
namespace {

constexpr double weighted_share = 0.776;  // variance that the robust weights leave of normal residuals
constexpr double fall_off = 1.7;          // exponent of the distance in the likeness of neighbours
constexpr int far = 8;                    // stations apart at which noise is no longer alike

/// Autocorrelation of a filter, two-sided around lag 0.
std::vector<double> autocorrelation(const std::vector<double>& filter) {
  std::vector<double> result(filter.size(), 0);
  for (std::size_t lag = 0; lag < filter.size(); ++lag)
    for (std::size_t i = 0; i + lag < filter.size(); ++i) result[lag] += filter[i] * filter[i + lag];
  return result;
}

/// Weights of the regression amid evenly spaced stations.
std::vector<double> even_kernel(double half_width, double spacing) {
  const int reach = static_cast<int>(std::ceil(half_width / spacing)) - 1;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  std::vector<double> tricube;
  for (int i = -reach; i <= reach; ++i) {
    const double t = i * spacing / half_width;
    tricube.push_back(std::pow(1 - std::abs(t * t * t), 3));
    const Eigen::Vector3d row(1, t, t * t);
    normal += tricube.back() * row * row.transpose();
  }
  const Eigen::Vector3d own = normal.ldlt().solve(Eigen::Vector3d::UnitX());
  std::vector<double> kernel;
  for (int i = -reach; i <= reach; ++i) {
    const double t = i * spacing / half_width;
    kernel.push_back(tricube[static_cast<std::size_t>(i + reach)] * (own[0] + own[1] * t + own[2] * t * t));
  }
  return kernel;
}

double at(const std::vector<double>& values, int lag) {
  const auto i = static_cast<std::size_t>(std::abs(lag));
  return i < values.size() ? values[i] : 0;
}

/// Variance that a filter of the given autocorrelation leaves of noise whose neighbours are `likeness` alike,
/// at a lag. The likeness falls off faster than an exponential and slower than a Gaussian, as that of grains
/// of one size seen in strips does.
double filtered(const std::vector<double>& filter, double likeness, int lag) {
  double sum = at(filter, lag);
  for (int m = 1; m < far; ++m)
    sum += std::pow(likeness, std::pow(m, fall_off)) * (at(filter, lag - m) + at(filter, lag + m));
  return sum;
}

/// Variance of the smoothed values over that of the residuals. The regression makes neighbouring residuals
/// unlike in a known way; what likeness they keep tells the noise's own.
double variance_ratio(const std::vector<double>& residuals, const std::vector<double>& kernel) {
  double squares = 0;
  double products = 0;
  for (std::size_t i = 0; i + 1 < residuals.size(); ++i) {
    if (std::isnan(residuals[i] * residuals[i + 1])) continue;
    squares += (residuals[i] * residuals[i] + residuals[i + 1] * residuals[i + 1]) / 2;
    products += residuals[i] * residuals[i + 1];
  }
  std::vector<double> left = kernel;
  for (double& weight : left) weight = -weight;
  left[left.size() / 2] += 1;
  const std::vector<double> of_residuals = autocorrelation(left);
  double low = 0;
  double high = 0.9;
  while (high - low > 1e-4) {
    const double likeness = (low + high) / 2;
    const bool more =
        squares > 0 &&
        filtered(of_residuals, likeness, 1) / filtered(of_residuals, likeness, 0) < products / squares;
    (more ? low : high) = likeness;
  }
  return filtered(autocorrelation(kernel), low, 0) / filtered(of_residuals, low, 0);
}

}  // namespace

Section section_of(const std::vector<Eigen::Vector2d>& pixels, const PhotoGeometry& geometry,
                   const Light& light) {
  Section section;
  for (const auto& pixel : pixels) {
    const Eigen::Vector3d point = geometry.bed_point(pixel, light);
    section.x.push_back(geometry.reading(point));
    section.y.push_back(point.y());
    section.z.push_back(point.z());
  }
  return section;
}

std::vector<double> scatter_sigma(const std::vector<double>& z, const LocalQuadratic& smooth,
                                  double half_width, double spacing) {
  const std::size_t n = z.size();
  const std::vector<double> kernel = even_kernel(half_width, spacing);
  std::vector<double> residuals(n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isnan(smooth.fit[i]) && smooth.robust_weight[i] > 0.1) residuals[i] = z[i] - smooth.fit[i];
  const double ratio = variance_ratio(residuals, kernel);
  const double even_gain = std::sqrt(autocorrelation(kernel)[0]);

  std::vector<double> sigma(n, std::numeric_limits<double>::quiet_NaN());
  constexpr std::size_t reach = 40;
  for (std::size_t i = 0; i < n; ++i) {
    double squares = 0;
    double count = 0;
    for (std::size_t k = i < reach ? 0 : i - reach; k < std::min(n, i + reach + 1); ++k)
      if (!std::isnan(residuals[k])) {
        squares += smooth.robust_weight[k] * residuals[k] * residuals[k];
        count += smooth.robust_weight[k];
      }
    // Beside gaps and ends the fit rests on fewer stations than amid even ones.
    if (count > 5)
      sigma[i] = std::sqrt(squares / count / weighted_share * ratio) *
                 std::max(1.0, smooth.noise_gain[i] / even_gain);
  }
  return sigma;
}

SharedError shared_error(const PhotoSetup& setup, const SetupGeometry& frame, const PhotoLight& source,
                         const Light& light, const std::vector<Eigen::Vector2d>& pixels,
                         const std::vector<double>& slope, bool zero_mean) {
  // The effects are smooth along the profile: some forty places tell them.
  const std::size_t stride = std::max<std::size_t>(1, pixels.size() / 40);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < pixels.size(); i += stride) places.push_back(i);
  if (places.back() + 1 != pixels.size()) places.push_back(pixels.size() - 1);
  std::vector<Eigen::Vector2d> chosen;
  for (const std::size_t i : places) chosen.push_back(pixels[i]);
  const Section best = section_of(chosen, *frame.geometry, light);

  SharedError error;
  std::vector<double> variance(chosen.size(), 0);
  const auto add = [&](const PhotoGeometry& geometry, const Light& moved_light) {
    const Section moved = section_of(chosen, geometry, moved_light);
    std::vector<double> effect;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      effect.push_back(moved.z[i] - best.z[i] - slope[places[i]] * (moved.x[i] - best.x[i]));
    const double shift =
        zero_mean ? std::accumulate(effect.begin(), effect.end(), 0.0) / static_cast<double>(effect.size())
                  : 0;
    for (std::size_t i = 0; i < effect.size(); ++i) variance[i] += std::pow(effect[i] - shift, 2);
    error.elevation = std::hypot(error.elevation, moved_light.elevation - light.elevation);
    error.azimuth = std::hypot(error.azimuth, moved_light.azimuth - light.azimuth);
  };

  for (const LightDoubt& doubt : light_doubts(setup, *frame.geometry, source, light))
    add(*frame.geometry, find_light(setup, *frame.geometry, source, doubt));
  if (frame.pose) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 7, 7>> axes(frame.pose->covariance);
    for (int k = 0; k < 7; ++k) {
      const double size = std::sqrt(std::max(0.0, axes.eigenvalues()[k]));
      if (size == 0) continue;
      const FullGeometry moved(frame.pose->moved(size * axes.eigenvectors().col(k)), setup.inclination);
      add(moved, find_light(setup, moved, source));
    }
  }

  std::size_t low = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    while (low + 2 < places.size() && places[low + 1] <= i) ++low;
    const double t =
        static_cast<double>(i - places[low]) / static_cast<double>(places[low + 1] - places[low]);
    error.sigma.push_back(std::sqrt((1 - t) * variance[low] + t * variance[low + 1]));
  }
  return error;
}

}  // namespace aeolian
