#include "shadow_score.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <limits>
#include <thread>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

namespace {

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Angle of the line that fits the true section best, against the horizontal.
double true_dip(const SetUp& set_up) {
  constexpr int stations = 400;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int i = 0; i <= stations; ++i) {
    const Eigen::Vector3d point =
        true_bed_point(set_up.scene, set_up.from + (set_up.to - set_up.from) * i / stations);
    const Eigen::Vector2d row(1, point.x());
    normal += row * row.transpose();
    right += row * point.z();
  }
  return std::atan(Eigen::Vector2d(normal.inverse() * right).y());
}

EnsembleMember measure_member(std::uint64_t seed, double megapixels) {
  EnsembleMember member;
  member.seed = seed;
  member.set_up = random_set_up(seed, megapixels);
  const Photo photo = photograph(member.set_up.scene);
  try {
    const double start = thread_seconds();
    member.profile = measure_shadow(photo, member.set_up.setup, ProfileMode::full);
    member.seconds = thread_seconds() - start;
    member.score = score(member.set_up, member.profile);
    member.wavelength = score_wavelength(member.set_up, analyse(member.profile));
  } catch (const Error& error) {
    member.refusal = error.what();
  }
  return member;
}

}  // namespace

ShadowScore score(const SetUp& set_up, const ShadowProfile& profile) {
  ShadowScore result;
  result.stations = profile.x.size();
  result.bar = std::max(set_up.scene.grain_diameter / 4, 1e-4);
  const auto n = static_cast<double>(result.stations);
  std::vector<double> errors;
  double mean = 0;
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    errors.push_back(profile.z[i] - true_bed_point(set_up.scene, profile.x[i]).z());
    mean += errors.back() / n;
  }
  // Heights are reported over the mean plane when its distance from the edge is given, else with zero mean.
  if (set_up.setup.height) result.bias = mean - *set_up.setup.height;
  const double zero = set_up.setup.height.value_or(mean);
  double squares = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares += (errors[i] - mean) * (errors[i] - mean) / n;
    if (std::abs(errors[i] - zero) <= 1.96 * profile.sigma_z[i]) ++result.covered;
  }
  result.rmse = std::sqrt(squares);
  return result;
}

WavelengthScore score_wavelength(const SetUp& set_up, const ProfileAnalysis& analysis) {
  WavelengthScore result;
  result.ripples = analysis.ripples.size();
  // The analysis measures along the bed, the set-up along the straightedge.
  const double along_bed = set_up.wavelength / std::cos(true_dip(set_up) - set_up.scene.inclination);
  result.error = analysis.train_wavelength.value / along_bed - 1;
  result.sigma = analysis.train_wavelength.sigma / along_bed;
  return result;
}

std::vector<EnsembleMember> measure_ensemble(std::uint64_t first, std::size_t count, double megapixels,
                                             unsigned threads) {
  std::vector<EnsembleMember> members(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) members[i] = measure_member(first + i, megapixels);
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return members;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace aeolian
