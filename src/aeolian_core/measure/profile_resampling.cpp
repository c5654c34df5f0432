#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

constexpr std::size_t fewest_stations = 8;

struct Stations {
  std::vector<double> x;  ///< along the horizontal [m]
  std::vector<double> z;
  std::vector<double> sigma;

  std::size_t size() const { return x.size(); }
  void add(double at, double height, double error) {
    x.push_back(at);
    z.push_back(height);
    sigma.push_back(error);
  }
  Stations part(std::size_t first, std::size_t end) const {
    Stations result;
    for (std::size_t i = first; i < end; ++i) result.add(x[i], z[i], sigma[i]);
    return result;
  }
};

/// The stations that hold numbers.
Stations measured(const ShadowProfile& profile) {
  if (profile.z.size() != profile.x.size() || profile.sigma_z.size() != profile.x.size())
    throw Error("profile: " + std::to_string(profile.x.size()) + " positions, " +
                std::to_string(profile.z.size()) + " heights and " + std::to_string(profile.sigma_z.size()) +
                " standard errors, must be as many of each");
  Stations stations;
  for (std::size_t i = 0; i < profile.x.size(); ++i)
    if (std::isfinite(profile.x[i]) && std::isfinite(profile.z[i]) && std::isfinite(profile.sigma_z[i]))
      stations.add(profile.x[i], profile.z[i], profile.sigma_z[i]);
  return stations;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/// Positions along the straightedge become horizontal. With the edge's inclination e, a bed point x along it
/// and c square to it lies at X = x cos e - c sin e and Z = x sin e + c cos e from the edge's origin; without
/// c, which is not measured, X = (x - Z sin e) / cos e. Z is the profile's z but for a constant, which the
/// mean drop fixes: Z = x sin e - drop in the mean.
void make_horizontal(Stations& stations, const ShadowProfile& profile) {
  const double sine = std::sin(profile.inclination);
  const double cosine = std::cos(profile.inclination);
  const double lift = mean(stations.x) * sine - profile.drop - mean(stations.z);
  for (std::size_t i = 0; i < stations.size(); ++i)
    stations.x[i] = (stations.x[i] - (stations.z[i] + lift) * sine) / cosine;
}

double median_spacing(const std::vector<double>& x) {
  std::vector<double> spacing;
  for (std::size_t i = 1; i < x.size(); ++i) spacing.push_back(x[i] - x[i - 1]);
  return median(spacing);
}

/// Without stations that hardly advance (noise on an inclined edge): cubics through them would swing.
Stations advancing(const Stations& stations, double spacing) {
  Stations result;
  for (std::size_t i = 0; i < stations.size(); ++i)
    if (result.x.empty() || stations.x[i] - result.x.back() > 0.25 * spacing)
      result.add(stations.x[i], stations.z[i], stations.sigma[i]);
  return result;
}

Stations longest_stretch(const Stations& stations, double max_gap) {
  std::size_t first = 0;
  std::size_t best_first = 0;
  std::size_t best_end = 0;
  double best = -1;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (i > 0 && stations.x[i] - stations.x[i - 1] > max_gap) first = i;
    if (stations.x[i] - stations.x[first] > best) {
      best = stations.x[i] - stations.x[first];
      best_first = first;
      best_end = i + 1;
    }
  }
  return stations.part(best_first, best_end);
}

/// The cubic through four neighbours of which k and k + 1 enclose x; over a gap the straight line, since a
/// cubic would carry the noise of the slopes at its ends far into it.
double interpolated(const Stations& stations, std::size_t k, double x, double spacing) {
  const auto& at = stations.x;
  const auto& z = stations.z;
  if (at[k + 1] - at[k] > 2.5 * spacing) {
    const double share = (x - at[k]) / (at[k + 1] - at[k]);
    return z[k] + share * (z[k + 1] - z[k]);
  }
  const std::size_t first = std::min(k == 0 ? 0 : k - 1, at.size() - 4);
  double sum = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (x - at[j]) / (at[i] - at[j]);
    sum += weight * z[i];
  }
  return sum;
}

[[noreturn]] void refuse(std::size_t left, double max_gap) {
  throw Error("profile: " + std::to_string(left) + " samples in a stretch without gaps over " +
              std::to_string(1000 * max_gap) + " mm, at least " + std::to_string(fewest_stations) +
              " are needed");
}

}  // namespace

EvenProfile resample(const ShadowProfile& profile, double step, double max_gap) {
  if (!(step > 0 && max_gap > 0))
    throw Error("resampling a profile: step " + std::to_string(step) + " m, largest gap " +
                std::to_string(max_gap) + " m: both must be positive");
  Stations stations = measured(profile);
  if (stations.size() < fewest_stations) refuse(stations.size(), max_gap);
  make_horizontal(stations, profile);
  const double spacing = median_spacing(stations.x);
  if (!(spacing > 0)) throw Error("profile: positions do not rise along the straightedge");
  stations = longest_stretch(advancing(stations, spacing), max_gap);
  const double length = stations.x.back() - stations.x.front();
  const auto count = static_cast<std::size_t>(length / step * (1 + 1e-12)) + 1;
  if (std::min(count, stations.size()) < fewest_stations) refuse(std::min(count, stations.size()), max_gap);

  EvenProfile even;
  even.start = stations.x.front();
  even.step = step;
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = even.start + step * static_cast<double>(i);
    while (k + 2 < stations.size() && stations.x[k + 1] <= x) ++k;
    even.z.push_back(interpolated(stations, k, x, spacing));
    even.sigma_z.push_back(std::max(stations.sigma[k], stations.sigma[k + 1]));
  }
  return even;
}

std::vector<double> detrended(const EvenProfile& profile, double* slope) {
  const auto n = static_cast<double>(profile.z.size());
  const double middle = 0.5 * (n - 1);
  double sum = 0;
  double moment = 0;
  for (std::size_t i = 0; i < profile.z.size(); ++i) {
    sum += profile.z[i];
    moment += (static_cast<double>(i) - middle) * profile.z[i];
  }
  const double level = sum / n;
  const double rise = n > 1 ? moment / (n * (n * n - 1) / 12) : 0;  // the sum of (i - middle)^2
  std::vector<double> rest(profile.z.size());
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[i] = profile.z[i] - level - rise * (static_cast<double>(i) - middle);
  if (slope != nullptr) *slope = rise / profile.step;
  return rest;
}

}  // namespace aeolian
