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
  const auto span = [](const std::array<Eigen::Vector2d, 4>& corners) {
    const auto [least, most] = std::minmax({corners[0].x(), corners[1].x(), corners[2].x(), corners[3].x()});
    return (most - least) / 2;  // view factor of an endless strip
  };
  double nearest = 1e9;
  for (std::size_t i = 0; i < 4; ++i) {
    const double z = (i & 1U ? high_.z() : low_.z()) - point.z();
    const Eigen::Vector2d across{(i & 2U ? high_.y() : low_.y()) - point.y(), z};
    const double distance = std::max(across.norm(), 1e-9);
    nearest = std::min(nearest, distance);
    sky.corners[i] = across / distance;
    sky.ends[i] = Eigen::Vector2d((i & 2U ? high_.x() : low_.x()) - point.x(), z);
    sky.ends[i] /= std::max(sky.ends[i].norm(), 1e-9);
  }
  sky.nearest = nearest;
  sky.blocked_skylight = span(sky.corners) * span(sky.ends);
  return sky;
}

BarShadow::Past BarShadow::past(const std::array<Eigen::Vector2d, 4>& corners, const Eigen::Vector2d& light) {
  // The third component of to_light lies along the edge and has no part in the angle to a plane through it.
  double least = 1;
  double most = -1;
  for (const Eigen::Vector2d& corner : corners) {
    const double side = corner.x() * light.y() - corner.y() * light.x();
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return {least, -most};
}

BarShadow::Angles BarShadow::angles(const Sky& sky, const Eigen::Vector3d& to_light) const {
  const Past across = past(sky.corners, {to_light.y(), to_light.z()});
  const Past along = past(sky.ends, {to_light.x(), to_light.z()});
  return {std::max(across.over, across.under), std::max(along.over, along.under)};
}

double BarShadow::seen_past_box(const Sky& sky, const Eigen::Vector3d& to_light) const {
  const auto blocked = [this](const Past& p) {
    return std::max(0.0, 1 - disc_below(std::asin(p.over) / disc_) - disc_below(std::asin(p.under) / disc_));
  };
  const double across = blocked(past(sky.corners, {to_light.y(), to_light.z()}));
  if (across == 0) return 1;
  return 1 - across * blocked(past(sky.ends, {to_light.x(), to_light.z()}));
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
