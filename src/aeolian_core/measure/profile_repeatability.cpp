#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Linear between samples; `at` in samples, held at the ends.
double height_at(const std::vector<double>& z, double at) {
  const double inside = std::clamp(at, 0.0, static_cast<double>(z.size() - 1));
  const std::size_t k = std::min(static_cast<std::size_t>(inside), z.size() - 2);
  const double share = inside - static_cast<double>(k);
  return z[k] + share * (z[k + 1] - z[k]);
}

}  // namespace

EvenProfile ripple_outline(const EvenProfile& profile, const ProfileRipple& ripple) {
  if (profile.z.size() < 2 || !(ripple.end > ripple.start)) throw Error("ripple outline: nothing to outline");
  const auto sample = [&](double x) { return (x - profile.start) / profile.step; };
  const double low = height_at(profile.z, sample(ripple.start));
  const double rise = height_at(profile.z, sample(ripple.end)) - low;
  const double angle = std::atan2(rise, ripple.end - ripple.start);

  // Points turned into the tangent's frame, then taken at even distances along it.
  std::vector<double> along;
  std::vector<double> over;
  const auto add = [&](double x, double z) {
    const double at = (x - ripple.start) * std::cos(angle) + (z - low) * std::sin(angle);
    if (!along.empty() && at <= along.back()) return;
    along.push_back(at);
    over.push_back((z - low) * std::cos(angle) - (x - ripple.start) * std::sin(angle));
  };
  add(ripple.start, low);
  for (std::size_t i = 0; i < profile.z.size(); ++i) {
    const double x = profile.start + profile.step * static_cast<double>(i);
    if (x > ripple.start && x < ripple.end) add(x, profile.z[i]);
  }
  add(ripple.end, low + rise);

  EvenProfile outline;
  const auto steps = std::max<std::size_t>(1, static_cast<std::size_t>(along.back() / profile.step));
  outline.step = along.back() / static_cast<double>(steps);
  std::size_t k = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double at = static_cast<double>(i) * outline.step;
    while (k + 2 < along.size() && along[k + 1] <= at) ++k;
    const double share = (at - along[k]) / (along[k + 1] - along[k]);
    outline.z.push_back(over[k] + share * (over[k + 1] - over[k]));
  }
  outline.sigma_z.assign(outline.z.size(), 0);
  for (std::size_t i = 0; i < outline.z.size() && !profile.sigma_z.empty(); ++i) {
    const double x = ripple.start + outline.step * static_cast<double>(i) * std::cos(angle);
    outline.sigma_z[i] = height_at(profile.sigma_z, sample(x));
  }
  return outline;
}

ProfileRepeatability profile_repeatability(const std::vector<EvenProfile>& outlines) {
  if (outlines.size() < 2)
    throw Error("repeatability: " + std::to_string(outlines.size()) + " outlines, at least two are needed");
  ProfileRepeatability result;
  const auto count = static_cast<double>(outlines.size());
  const auto length = [](const EvenProfile& o) { return o.step * static_cast<double>(o.z.size() - 1); };
  for (const EvenProfile& outline : outlines) {
    if (outline.z.size() < 2) throw Error("repeatability: an outline has fewer than two samples");
    result.wavelength += length(outline) / count;
  }
  constexpr std::size_t places = 101;
  result.mean.step = result.wavelength / (places - 1);
  double variance_sum = 0;
  for (std::size_t p = 0; p < places; ++p) {
    const double place = static_cast<double>(p) / (places - 1);
    double sum = 0;
    double squares = 0;
    for (const EvenProfile& outline : outlines) {
      const double z = result.wavelength / length(outline) *
                       height_at(outline.z, place * static_cast<double>(outline.z.size() - 1));
      sum += z;
      squares += z * z;
    }
    const double variance = std::max(0.0, (squares - sum * sum / count) / (count - 1));
    result.mean.z.push_back(sum / count);
    result.mean.sigma_z.push_back(std::sqrt(variance));
    variance_sum += variance;
  }
  result.deviation = std::sqrt(variance_sum / places);
  return result;
}

}  // namespace aeolian
