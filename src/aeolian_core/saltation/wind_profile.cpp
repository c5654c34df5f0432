#include "aeolian_core/saltation/wind_profile.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

constexpr std::size_t knots_per_level = WindProfile::Table::per_octave / WindProfile::levels_per_octave;

}  // namespace

WindProfile::WindProfile(double roughness)
    : roughness_(roughness),
      inverse_roughness_(1 / roughness),
      height_(levels),
      speed_(levels),
      shear_(levels),
      table_(0, octaves) {
  if (!(roughness > 0 && std::isfinite(roughness)))
    throw Error("wind profile: the roughness length is " + std::to_string(roughness) +
                " m, must be positive");
  for (std::size_t i = 0; i < levels; ++i) height_[i] = roughness * table_.knot(i * knots_per_level);
  for (std::size_t k = 0; k < table_.pieces(); ++k) {
    const double begin = table_.knot(k / knots_per_level * knots_per_level);
    const double end = table_.knot((k / knots_per_level + 1) * knots_per_level);
    log_step_.push_back(std::log(table_.knot(k + 1) / table_.knot(k)));
    log_part_.push_back(std::log(table_.knot(k + 1) / begin) / std::log(end / begin));
  }
}

void WindProfile::set_logarithmic(double friction_velocity) {
  set(friction_velocity, friction_velocity, std::vector<double>(levels, 0.0));
}

void WindProfile::set(double friction_velocity, double surface, const std::vector<double>& share) {
  const double free = friction_velocity * friction_velocity;
  const double borne = free - surface * surface;
  for (std::size_t i = 0; i < levels; ++i) {
    const double stress = free - borne * share[i];
    shear_[i] = std::copysign(std::sqrt(std::abs(stress)), stress);
  }
  double speed = 0;
  for (std::size_t i = 0; i + 1 < levels; ++i) {
    speed_[i] = speed;
    double shear = shear_[i];
    for (std::size_t k = i * knots_per_level; k < (i + 1) * knots_per_level; ++k) {
      const double next_shear = shear_[i] + log_part_[k] * (shear_[i + 1] - shear_[i]);
      const double next = speed + 0.5 * (shear + next_shear) * log_step_[k] / von_karman;
      table_.set(k, speed, next);
      speed = next;
      shear = next_shear;
    }
  }
  speed_.back() = speed;
}

double WindProfile::speed(double height) const {
  return height <= roughness_ ? 0 : table_(std::min(height / roughness_, top));
}

double WindProfile::apparent_roughness() const {
  return height_.back() * std::exp(-von_karman * speed_.back() / shear_.back());
}

}  // namespace aeolian
