#include "aeolian_core/grains/impacts/impact.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"shot"};

void require_valid(const Shot& shot) {
  require(shot.speed > 0 && std::isfinite(shot.speed), "speed", shot.speed, "positive");
  require(shot.angle >= degree * (1 - 1e-9) && shot.angle <= 90 * degree * (1 + 1e-9), "angle", shot.angle,
          "0.01745 to 1.5708 (1 to 90 degrees)");
  require(shot.size_ratio >= 0.1 && shot.size_ratio <= 10, "size_ratio", shot.size_ratio, "0.1 to 10");
}

template <int Dim>
Eigen::Vector3d in_flight_frame(const Vector<Dim>& v) {
  if constexpr (Dim == 2)
    return {v.x(), 0, v.y()};
  else
    return v;
}

/// One impact from the launch to its end.
template <int Dim>
class ImpactRun {
 public:
  ImpactRun(const Bed<Dim>& bed, const Shot& shot, const ImpactRules& rules, const ImpactWatch<Dim>& watch)
      : bed_(bed),
        watch_(watch),
        grains_(bed.grains),
        gravity_(bed.grains.world().acceleration.norm()),
        plane_(bed.surface.top() + 2 * bed.radius),
        follow_(rules.follow * std::sqrt(bed.radius / gravity_)),
        end_when_calm_(rules.end_when_calm) {
    outcome_.shot = shot;
    if (rules.sleep.speed > 0) {
      GrainWorld<Dim> world = grains_.world();
      world.sleep = rules.sleep;
      grains_.set_world(world);
    }
  }

  ImpactOutcome run() {
    const std::size_t before = grains_.grain_steps();
    launch();
    if (approach()) follow();
    outcome_.steps = static_cast<double>(grains_.grain_steps() - before);
    return outcome_;
  }

 private:
  /// Grains are looked through for those that have risen once in so many steps: a small part of a contact.
  static constexpr int steps_per_look = 16;

  void launch() {
    const Shot& shot = outcome_.shot;
    const double radius = shot.size_ratio * bed_.radius;
    Vector<Dim> velocity = Vector<Dim>::Zero();
    velocity.x() = shot.speed * std::cos(shot.angle);
    velocity[Dim - 1] = -shot.speed * std::sin(shot.angle);
    const double height = bed_.surface.top() + radius * (1 + 1e-6);
    Vector<Dim> place;
    place.x() = shot.along - (height - bed_.surface.mean_height()) / std::tan(shot.angle);
    if constexpr (Dim == 3) place.y() = shot.across;
    place[Dim - 1] = height;
    const auto& period = bed_.grains.world().period;
    for (int k = 0; k < Dim; ++k)
      if (period[k] > 0) place[k] -= period[k] * std::floor(place[k] / period[k]);
    incident_ = grains_.add(place, radius, velocity);
    bed_mass_ = grains_.mass(incident_) / std::pow(shot.size_ratio, Dim);
    outcome_.incident_mass = grains_.mass(incident_) / bed_mass_;
  }

  /// Until the grain meets the bed; whether it does.
  bool approach() {
    const double path =
        (bed_.surface.top() + 2 * outcome_.shot.size_ratio * bed_.radius) / std::sin(outcome_.shot.angle);
    const double longest = grains_.time() + 4 * path / outcome_.shot.speed;
    while (grains_.time() < longest) {
      const Vector<Dim> velocity = grains_.velocity(incident_);
      grains_.step();
      if (watch_) watch_(grains_, incident_, -1);
      for (const auto& contact : grains_.contacts(incident_)) {
        if (contact.second < 0 || contact.first < 0) continue;
        meet(contact, velocity);
        return true;
      }
    }
    return false;
  }

  /// The normal is taken from the target to the incident grain, whichever of the two is named first.
  void meet(const GrainContact<Dim>& contact, const Vector<Dim>& velocity) {
    const bool first = contact.first == incident_;
    const int target = first ? contact.second : contact.first;
    normal_ = first ? contact.normal : Vector<Dim>(-contact.normal);
    begin_ = grains_.time();
    const Vector<Dim> point = grains_.position(incident_) - grains_.radius(incident_) * normal_;
    point_ = point;
    FirstContact met{};
    met.target = target;
    met.step = bed_.surface.step(target);
    met.normal_angle = std::atan2(-normal_.x(), normal_[Dim - 1]);
    met.approach = -velocity.dot(normal_);
    met.departure = std::nan("");
    met.effective_mass = std::nan("");
    outcome_.contact = met;
    struck_.insert(target);
    touching_ = true;
  }

  void follow() {
    const double end = begin_ + follow_;
    for (int i = 1; grains_.time() < end; ++i) {
      grains_.step(end - grains_.time());
      if (incident_ >= 0) watch_incident();
      if (watch_) watch_(grains_, incident_, grains_.time() - begin_);
      if (i % steps_per_look == 0) {
        look_for_risen();
        if (end_when_calm_ && is_calm()) break;
      }
    }
    look_for_risen();
    finish_contact();
  }

  /// Whom the grain touches, and how fast it leaves the first.
  void watch_incident() {
    bool touches_target = false;
    for (const auto& contact : grains_.contacts(incident_)) {
      const int other = contact.first == incident_ ? contact.second : contact.first;
      if (other < 0) continue;
      struck_.insert(other);
      touches_target = touches_target || other == outcome_.contact->target;
    }
    if (touching_ && !touches_target) {
      touching_ = false;
      outcome_.contact->departure = grains_.velocity(incident_).dot(normal_);
    }
  }

  /// M from c4 = (epsilon - m / M) / (1 + m / M), the ratio of the normal speeds.
  void finish_contact() {
    FirstContact& contact = *outcome_.contact;
    contact.struck = static_cast<int>(struck_.size());
    if (contact.struck > 1 || !std::isfinite(contact.departure)) return;
    const ContactLaw& law = grains_.world().law;
    const double target_mass = bed_.grains.mass(contact.target);
    const double mass = outcome_.incident_mass * bed_mass_;
    const double reduced = mass * target_mass / (mass + target_mass);
    const double epsilon = law.kind == ContactLaw::Kind::spring
                               ? restitution(law.stiffness, law.damping, reduced)
                               : law.restitution;
    const double ratio = contact.departure / contact.approach;
    const double mass_ratio = (epsilon - ratio) / (1 + ratio);
    if (mass_ratio > 0) contact.effective_mass = outcome_.incident_mass / mass_ratio;
  }

  void look_for_risen() {
    risen_.clear();
    for (const int grain : grains_.moving())
      if (grains_.position(grain)[Dim - 1] > plane_ && grains_.velocity(grain)[Dim - 1] > 0)
        risen_.push_back(grain);
    std::sort(risen_.begin(), risen_.end());
    for (const int grain : risen_) {
      note(grain);
      grains_.remove(grain);
    }
  }

  void note(int grain) {
    RisenGrain risen;
    risen.grain = grain;
    risen.time = grains_.time() - begin_;
    risen.radius = grains_.radius(grain);
    risen.spin = grains_.spin(grain).norm();
    risen.place = in_flight_frame<Dim>(grains_.position(grain));
    risen.velocity = in_flight_frame<Dim>(grains_.velocity(grain));
    if (grain == incident_) {
      risen.origin.setZero();
      risen.layer = 0;
      risen.kind = Origin::rebound;
      outcome_.rebound = risen;
      incident_ = -1;
      return;
    }
    Vector<Dim> origin = bed_.grains.position(grain) - point_;
    const auto& period = bed_.grains.world().period;
    for (int k = 0; k < Dim; ++k)
      if (period[k] > 0) origin[k] -= period[k] * std::round(origin[k] / period[k]);
    risen.origin = in_flight_frame<Dim>(origin);
    risen.layer = bed_.surface.layer(grain);
    risen.kind = grain == outcome_.contact->target ? Origin::target : bed_.surface.step(grain);
    outcome_.ejecta.push_back(risen);
  }

  /// No grain has the energy to reach the plane.
  bool is_calm() const {
    for (const int grain : grains_.moving()) {
      const double rise = plane_ - grains_.position(grain)[Dim - 1];
      if (grains_.velocity(grain).squaredNorm() >= 2 * gravity_ * rise) return false;
    }
    return true;
  }

  const Bed<Dim>& bed_;
  const ImpactWatch<Dim>& watch_;
  GrainDynamics<Dim> grains_;
  double gravity_;
  double plane_;
  double follow_;
  bool end_when_calm_;
  ImpactOutcome outcome_;
  int incident_ = -1;
  double bed_mass_ = 0;
  double begin_ = 0;
  Vector<Dim> normal_, point_;
  bool touching_ = false;
  std::set<int> struck_;
  std::vector<int> risen_;
};

}  // namespace

template <int Dim>
ImpactOutcome fire(const Bed<Dim>& bed, const Shot& shot, const ImpactRules& rules,
                   const ImpactWatch<Dim>& watch) {
  require_valid(shot);
  return ImpactRun<Dim>(bed, shot, rules, watch).run();
}

SplashEvent splash_event(const ImpactOutcome& outcome, double bed_radius) {
  const auto leaving = [&](const RisenGrain& risen) {
    LeavingGrain grain;
    grain.velocity = risen.velocity;
    const double drop = 2 * bed_radius;
    grain.velocity.z() = std::sqrt(risen.velocity.z() * risen.velocity.z() + 2 * gravity * drop);
    grain.size_ratio = risen.radius / bed_radius;
    grain.distance = risen.origin.x();
    grain.origin = risen.kind;
    return grain;
  };
  SplashEvent event;
  if (outcome.rebound) event.rebound = leaving(*outcome.rebound);
  for (const RisenGrain& risen : outcome.ejecta) event.ejecta.push_back(leaving(risen));
  return event;
}

template ImpactOutcome fire(const Bed<2>&, const Shot&, const ImpactRules&, const ImpactWatch<2>&);
template ImpactOutcome fire(const Bed<3>&, const Shot&, const ImpactRules&, const ImpactWatch<3>&);

}  // namespace aeolian
