#include "aeolian_twin/photo/measured_photo.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/measure/profile_strip.hpp"
#include "aeolian_twin/photo/figure_text.hpp"
#include "aeolian_twin/photo/figure_units.hpp"

namespace aeolian {

std::vector<double> horizontal_places(const ShadowProfile& profile) {
  std::vector<double> places;
  for (const Eigen::Vector3d& point : bed_points(profile)) places.push_back(point.x());
  return places;
}

double height_at(const EvenProfile& even, double place) {
  const double last = static_cast<double>(even.z.size() - 1);
  const double at = std::clamp((place - even.start) / even.step, 0.0, last);
  const double left = std::min(std::floor(at), last - 1);
  const auto i = static_cast<std::size_t>(left);
  return even.z[i] + (at - left) * (even.z[i + 1] - even.z[i]);
}

std::string in_one_line(const ProfileAnalysis& analysis, const std::string& between) {
  if (analysis.ripples.empty())
    return fmt::format("no ripples, roughness {} mm", stated(analysis.roughness, to_mm, between));
  return fmt::format("{} ripple{}, wavelength {} mm, height {} mm, index {}", analysis.ripples.size(),
                     analysis.ripples.size() == 1 ? "" : "s", stated(analysis.wavelength, to_mm, between),
                     stated(analysis.height, to_mm, between), stated(analysis.index, 1, between));
}

}  // namespace aeolian
