#include "aeolian_core/bedforms/erosion/bounce.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr float grazing = 0.02F;  ///< least sine of the angle of impact

}  // namespace

BounceResult bounced(const Bounce& bounce, const Eigen::Vector3f& velocity, float slope_x, float slope_y,
                     float unit, float drawn) {
  BounceResult result;
  const Eigen::Vector3f normal = Eigen::Vector3f(-slope_x, -slope_y, 1).normalized();
  const float speed = velocity.norm();
  const float falls = -velocity.dot(normal);
  const Eigen::Vector3f along = velocity + falls * normal;
  const float towards = std::max(falls, grazing * speed);
  const float sine = speed > 0 ? std::min(towards / speed, 1.0F) : 1;

  const float restitution = 0.87F - 0.72F * sine;
  result.pushed = std::max(0.0F, 13 * (1 - restitution * restitution) * (speed / (40 * unit) - 1));
  if (bounce.law == BounceLaw::attenuated) {
    result.velocity = static_cast<float>(bounce.normal_kept) * towards * normal +
                      static_cast<float>(bounce.tangential_kept) * along;
    result.captured = speed < static_cast<float>(bounce.capture_speed);
    return result;
  }
  const float kept = restitution * speed;
  const float up = std::min(kept, speed * (0.30F - 0.15F * sine));
  const float on = std::sqrt(std::max(0.0F, kept * kept - up * up));
  const float length = along.norm();
  result.velocity = up * normal;
  if (length > 0) result.velocity += on / length * along;
  const double chance = bounce.rebound_share * (1 - std::exp(-speed / bounce.rebound_speed));
  result.captured = kept < static_cast<float>(bounce.capture_speed) || !(drawn < static_cast<float>(chance));
  return result;
}

}  // namespace aeolian
