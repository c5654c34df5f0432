#include "aeolian_twin/splash/impact_film.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

template <int Dim>
Eigen::Vector3d in_space(const Vector<Dim>& v) {
  if constexpr (Dim == 2)
    return {v.x(), 0, v.y()};
  else
    return v;
}

template <int Dim>
std::vector<FilmGrain> seen(const GrainDynamics<Dim>& grains, int incident) {
  std::vector<FilmGrain> result;
  for (const int grain : grains.numbers())
    result.push_back({in_space<Dim>(grains.position(grain)), grains.radius(grain),
                      grains.velocity(grain).norm(), grain == incident});
  return result;
}

/// Brings the neighbours of a periodic bed behind the impact, the nearest half a diameter in front of it.
class Surroundings {
 public:
  Surroundings(const Eigen::Vector3d& impact, const Eigen::Vector2d& period, double diameter)
      : impact_(impact), period_(period), front_(0.5 * diameter) {}

  Eigen::Vector3d placed(Eigen::Vector3d place) const {
    if (period_.x() > 0) place.x() -= period_.x() * std::round((place.x() - impact_.x()) / period_.x());
    if (period_.y() > 0) {
      const double depth = place.y() - impact_.y() + front_;
      place.y() -= period_.y() * std::floor(depth / period_.y());
    }
    return place;
  }
  FilmGrain in_flight(const RisenGrain& risen, double time) const {
    const double dt = time - risen.time;
    Eigen::Vector3d velocity = risen.velocity;
    const Eigen::Vector3d place =
        placed(risen.place) + dt * velocity - 0.5 * gravity * dt * dt * Eigen::Vector3d::UnitZ();
    velocity.z() -= gravity * dt;
    return {place, risen.radius, velocity.norm(), risen.kind == Origin::rebound};
  }

 private:
  Eigen::Vector3d impact_;
  Eigen::Vector2d period_;
  double front_;
};

}  // namespace

template <int Dim>
Film film_impact(const Bed<Dim>& bed, const Shot& shot, ImpactRules rules, const std::vector<double>& times) {
  const Eigen::Vector2d period = bed.grains.world().period.template head<2>() * (Dim == 3 ? 1 : 0);
  Film film{{}, shot, 2 * bed.radius, bed.surface.top(), bed.length, period.x() > 0, Eigen::Vector3d::Zero()};
  std::size_t next = 0;
  while (next < times.size() && times[next] < 0) film.frames.push_back({times[next++], seen(bed.grains, -1)});
  const std::size_t before = next;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  rules.end_when_calm = false;
  const ImpactOutcome outcome =
      fire<Dim>(bed, shot, rules, [&](const GrainDynamics<Dim>& grains, int incident, double time) {
        if (time < 0) {
          film.impact = in_space<Dim>(grains.position(incident));
          velocity = in_space<Dim>(grains.velocity(incident));
        }
        for (; next < times.size() && time >= times[next]; ++next)
          film.frames.push_back({time, seen(grains, incident)});
      });
  if (!outcome.contact) throw Error("picture: the shot misses the bed");
  const Surroundings around(film.impact, period, film.diameter);
  const double radius = shot.size_ratio * bed.radius;
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    FilmFrame& frame = film.frames[i];
    for (FilmGrain& grain : frame.grains) grain.place = around.placed(grain.place);
    if (i < before) frame.grains.push_back({film.impact + frame.time * velocity, radius, shot.speed, true});
    if (outcome.rebound && frame.time > outcome.rebound->time)
      frame.grains.push_back(around.in_flight(*outcome.rebound, frame.time));
    for (const RisenGrain& risen : outcome.ejecta)
      if (frame.time > risen.time) frame.grains.push_back(around.in_flight(risen, frame.time));
    std::stable_sort(frame.grains.begin(), frame.grains.end(),
                     [](const FilmGrain& a, const FilmGrain& b) { return a.place.y() > b.place.y(); });
  }
  return film;
}

template Film film_impact(const Bed<2>&, const Shot&, ImpactRules, const std::vector<double>&);
template Film film_impact(const Bed<3>&, const Shot&, ImpactRules, const std::vector<double>&);

}  // namespace aeolian
