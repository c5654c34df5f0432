#include "aeolian_core/grains/splash/rebound_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aeolian_core/grains/splash/bed_view.hpp"
#include "aeolian_core/grains/splash/unit_vector.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

constexpr Require require{"rebound model"};

ReboundModel::Parameters checked(const ReboundModel::Parameters& p) {
  require(p.restitution >= 0 && p.restitution <= 1, "restitution", p.restitution, "0 to 1");
  require(std::abs(p.friction_restitution) <= 1, "friction restitution", p.friction_restitution, "-1 to 1");
  require(p.inertia > 0 && p.inertia <= 1, "inertia", p.inertia, "above 0, to 1");
  require(p.bed_inertia > 0, "inertia of the bed's grains", p.bed_inertia, "positive");
  require(p.gap >= 0 && p.gap <= 10, "gap", p.gap, "0 to 10 radii");
  require(std::isfinite(p.spin), "spin", p.spin, "finite");
  require(p.mass >= 0 && p.mass_share >= 0 && p.mass + p.mass_share > 0, "effective mass", p.mass,
          "positive, with its share not negative");
  require(p.mass_exponent >= 0 && p.mass_exponent <= 3, "exponent of mass", p.mass_exponent, "0 to 3");
  require(p.most_collisions == 1 || p.most_collisions == 2, "number of collisions", p.most_collisions,
          "1 or 2");
  return p;
}

TwoBodyRebound collision_of(const ReboundModel::Parameters& p, double size_ratio) {
  const double mass =
      p.mass_exponent == 3 ? size_ratio * size_ratio * size_ratio : std::pow(size_ratio, p.mass_exponent);
  return TwoBodyRebound({mass / (p.mass + p.mass_share * mass), p.restitution, p.friction_restitution,
                         p.inertia, p.bed_inertia});
}

/// When a point at `place`, seen from the middle of a circle, meets it; both lengths and `speed` in the same
/// unit.
double meeting_time(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity, double radius) {
  const double approach = place.dot(velocity);
  if (approach >= 0) return never;
  const double speed2 = velocity.squaredNorm();
  const double square = approach * approach - speed2 * (place.squaredNorm() - radius * radius);
  return square <= 0 ? never : (-approach - std::sqrt(square)) / speed2;
}

}  // namespace

ReboundModel::Parameters ReboundModel::thesis_case(int number) {
  Parameters p;
  p.inertia = 0.5;
  p.mass_exponent = 0;
  if (number == 1) {
    p.bed_inertia = 0.5;
    p.restitution = 0.6;
    p.friction_restitution = 1;
  } else if (number == 2) {
    p.bed_inertia = 1;
    p.restitution = 0.85;
    p.friction_restitution = 0;
  } else {
    throw Error("rebound model: case is " + std::to_string(number) + ", must be 1 or 2");
  }
  return p;
}

ReboundModel::ReboundModel(const Parameters& parameters)
    : parameters_(checked(parameters)), equal_sizes_(collision_of(parameters, 1)) {}

TwoBodyRebound ReboundModel::collision(double size_ratio) const {
  return size_ratio == 1 ? equal_sizes_ : collision_of(parameters_, size_ratio);
}

// Lengths in radii of the bed's grains: their middles lie at k * pitch on y = 0, and the grain's middle meets
// circles of radius 1 + size ratio about them. `h` is the ray's distance from the middle of grain 0, upward
// across the ray: grain 0 is the first whose top the ray does not pass over.
ReboundModel::Bounce ReboundModel::bounce(double angle, double size_ratio, double offset) const {
  const double radius = 1 + size_ratio;
  const double pitch = 2 + parameters_.gap;
  const Eigen::Vector2d direction = unit_vector(angle);
  const double cosine = direction.x();
  const double sine = direction.y();
  const double h = radius - (1 - offset) * pitch * sine;
  const Eigen::Vector2d path(cosine, -sine);

  double first = never;
  int target = 0;
  for (int k = 0; k * pitch * sine - radius < h && k * pitch * cosine - radius < first; ++k) {
    const double aside = h - k * pitch * sine;
    const double square = radius * radius - aside * aside;
    if (square <= 0) continue;
    const double time = k * pitch * cosine - std::sqrt(square);
    if (time < first) {
      first = time;
      target = k;
    }
  }
  if (first == never) return {Eigen::Vector2d::Zero(), 0, true, 0};

  const TwoBodyRebound two_bodies = collision(size_ratio);
  double spin = parameters_.spin;
  Eigen::Vector2d place = h * Eigen::Vector2d(sine, cosine) + first * path;
  const Eigen::Vector2d normal = (place - Eigen::Vector2d(target * pitch, 0)) / radius;
  Bounce result{two_bodies.velocity_after(path, normal, spin), 1, false, -normal.x()};
  const auto next_after = [&](int from, int& next) {
    double soonest = never;
    for (int k = from - 2; k <= from + 2; ++k) {
      if (k == from) continue;
      const double time = meeting_time(place - Eigen::Vector2d(k * pitch, 0), result.velocity, radius);
      if (time < soonest) {
        soonest = time;
        next = k;
      }
    }
    return soonest;
  };
  int second = target;
  const double until_second = parameters_.most_collisions == 1 ? never : next_after(target, second);
  bool third = false;
  if (until_second < never) {
    place += until_second * result.velocity;
    const Eigen::Vector2d away = (place - Eigen::Vector2d(second * pitch, 0)) / radius;
    result.velocity = two_bodies.velocity_after(result.velocity, away, spin);
    result.collisions = 2;
    int last = second;
    third = next_after(second, last) < never;
  }
  if (third || result.velocity.y() <= 0) {
    result.velocity.setZero();
    result.captured = true;
  }
  return result;
}

ReboundModel::Means ReboundModel::means(const Impact& impact, int rays) const {
  check(impact);
  const BedView bed(impact);
  Means sum{};
  double leave = 0;
  for (int i = 0; i < rays; ++i) {
    const Bounce one = bounce(bed.angle(), impact.size_ratio, (i + 0.5) / rays);
    const Eigen::Vector3d velocity = bed.velocity(one.velocity.x(), one.velocity.y());
    sum.along += velocity.x() / std::cos(impact.angle);
    sum.upward += velocity.z() / std::sin(impact.angle);
    sum.contact_angle += std::asin(one.upstream);
    sum.twice += one.collisions == 2 ? 1 : 0;
    if (one.captured) {
      sum.captured += 1;
    } else {
      sum.from_vertical += std::atan2(velocity.x(), velocity.z());
      leave += 1;
    }
  }
  return {sum.along / rays,         sum.upward / rays,   leave > 0 ? sum.from_vertical / leave : 0,
          sum.contact_angle / rays, sum.captured / rays, sum.twice / rays};
}

std::optional<LeavingGrain> ReboundModel::sample(const Impact& impact, RandomStream& random) const {
  const BedView bed(impact);
  const Bounce one = bounce(bed.angle(), impact.size_ratio, random.uniform());
  if (one.captured) return std::nullopt;
  return LeavingGrain{bed.velocity(impact.speed * one.velocity.x(), impact.speed * one.velocity.y()),
                      impact.size_ratio, 0, Origin::rebound};
}

double mean_contact_angle(double angle) {
  const double widest = std::acos(1 - std::sin(angle));
  return (std::sin(widest) - widest * std::cos(widest)) / (1 - std::cos(widest)) - angle;
}

}  // namespace aeolian
