#include "bar_shadow.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

double disc_below(double offset) {
  if (offset >= 1) return 1;
  if (offset <= -1) return 0;
  return 1 - (std::acos(offset) - offset * std::sqrt(1 - offset * offset)) / M_PI;
}

BarShadow::BarShadow(const ShadowScene& scene)
    : low_(scene.from, scene.shadow_side > 0 ? -scene.width : 0, -scene.thickness),
      high_(scene.to, scene.shadow_side > 0 ? 0 : scene.width, 0),
      disc_(std::max(scene.sun_diameter / 2, 1e-9)),
      post_height_(scene.post_height.value_or(0)),
      post_x_(scene.post_x) {}

BarShadow::Sky BarShadow::sky(const Eigen::Vector3d& point) const {
  Sky sky;
  const Eigen::Vector3d low = low_ - point;
  const Eigen::Vector3d high = high_ - point;
  const Eigen::Array4d up{low.z(), high.z(), low.z(), high.z()};
  const auto section = [&up](double near, double far, Sky::Section* s) {
    const Eigen::Array4d sideways{near, near, far, far};
    const Eigen::Array4d inverse = (sideways * sideways + up * up).max(1e-18).sqrt().inverse();
    s->sideways = sideways * inverse;
    s->up = up * inverse;
    return inverse;
  };
  sky.nearest = 1 / section(low.y(), high.y(), &sky.across).maxCoeff();
  section(low.x(), high.x(), &sky.along);
  // The view factor of an endless strip, in both directions.
  sky.blocked_skylight = (sky.across.sideways.maxCoeff() - sky.across.sideways.minCoeff()) *
                         (sky.along.sideways.maxCoeff() - sky.along.sideways.minCoeff()) / 4;
  return sky;
}

BarShadow::Past BarShadow::past(const Sky::Section& section, double light_sideways, double light_up) {
  // The third component of the light lies along the edge and has no part in the angle to a plane through it.
  const Eigen::Array4d side = section.sideways * light_up - section.up * light_sideways;
  return {side.minCoeff(), -side.maxCoeff()};
}

BarShadow::Angles BarShadow::angles(const Sky& sky, const Eigen::Vector3d& to_light) const {
  const Past across = past(sky.across, to_light.y(), to_light.z());
  const Past along = past(sky.along, to_light.x(), to_light.z());
  return {std::max(across.over, across.under), std::max(along.over, along.under)};
}

double BarShadow::seen_past_box(const Sky& sky, const Eigen::Vector3d& to_light) const {
  const auto blocked = [this](const Past& p) {
    return std::max(0.0, 1 - disc_below(std::asin(p.over) / disc_) - disc_below(std::asin(p.under) / disc_));
  };
  const double across = blocked(past(sky.across, to_light.y(), to_light.z()));
  if (across == 0) return 1;
  return 1 - across * blocked(past(sky.along, to_light.x(), to_light.z()));
}

double BarShadow::seen_past_post(const Eigen::Vector3d& point, const Eigen::Vector3d& to_light) const {
  if (post_height_ <= 0) return 1;
  const double x = post_x_ - point.x();
  const double y = -point.y();
  const double distance = std::hypot(x, y);
  if (x * to_light.x() + y * to_light.y() <= 0 || distance < post_radius) return 1;
  const double off_axis = (x * to_light.y() - y * to_light.x()) / distance;
  const double half_width = post_radius / distance * std::hypot(to_light.x(), to_light.y());
  if (std::abs(off_axis) > disc_ + half_width) return 1;
  const double strip =
      disc_below((off_axis + half_width) / disc_) - disc_below((off_axis - half_width) / disc_);
  // The tip is where the light's height over the post's foot reaches its height along the horizontal way.
  const double rise = to_light.z() / std::hypot(to_light.x(), to_light.y());
  const double top = std::atan2(post_height_ - point.z(), distance) - std::atan(rise);
  const double foot = std::atan2(-point.z(), distance) - std::atan(rise);
  return 1 - strip * disc_below(top / disc_) * (1 - disc_below(foot / disc_));
}

bool BarShadow::near_post(const Eigen::Vector3d& point, const Eigen::Vector3d& to_light, double reach) const {
  if (post_height_ <= 0) return false;
  const double x = post_x_ - point.x();
  const double y = -point.y();
  const double off_axis = std::abs(x * to_light.y() - y * to_light.x());
  return off_axis < post_radius + reach + disc_ * (std::hypot(x, y) + post_height_);
}

}  // namespace aeolian
