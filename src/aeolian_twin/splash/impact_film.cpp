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

FilmGrain in_flight(const RisenGrain& risen, double time) {
  const double dt = time - risen.time;
  Eigen::Vector3d velocity = risen.velocity;
  const Eigen::Vector3d place =
      risen.place + dt * velocity - 0.5 * gravity * dt * dt * Eigen::Vector3d::UnitZ();
  velocity.z() -= gravity * dt;
  return {place, risen.radius, velocity.norm(), risen.kind == Origin::rebound};
}

/// Brings the neighbours of a periodic bed behind the impact, the nearest half a diameter in front of it.
void arrange(FilmFrame& frame, const Eigen::Vector3d& impact, const Eigen::Vector2d& period,
             double diameter) {
  for (FilmGrain& grain : frame.grains) {
    if (period.x() > 0)
      grain.place.x() -= period.x() * std::round((grain.place.x() - impact.x()) / period.x());
    if (period.y() > 0) {
      const double depth = grain.place.y() - impact.y() + 0.5 * diameter;
      grain.place.y() = impact.y() - 0.5 * diameter + depth - period.y() * std::floor(depth / period.y());
    }
  }
  std::stable_sort(frame.grains.begin(), frame.grains.end(),
                   [](const FilmGrain& a, const FilmGrain& b) { return a.place.y() > b.place.y(); });
}

}  // namespace

template <int Dim>
Film film_impact(const Bed<Dim>& bed, const Shot& shot, ImpactRules rules, const std::vector<double>& times) {
  Film film{{}, shot, 2 * bed.radius, bed.surface.top(), bed.length, Eigen::Vector3d::Zero()};
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
  const double radius = shot.size_ratio * bed.radius;
  for (std::size_t i = 0; i < before; ++i) {
    FilmFrame& frame = film.frames[i];
    frame.grains.push_back({film.impact + frame.time * velocity, radius, shot.speed, true});
  }
  const auto& period = bed.grains.world().period;
  for (FilmFrame& frame : film.frames) {
    if (outcome.rebound && frame.time > outcome.rebound->time)
      frame.grains.push_back(in_flight(*outcome.rebound, frame.time));
    for (const RisenGrain& risen : outcome.ejecta)
      if (frame.time > risen.time) frame.grains.push_back(in_flight(risen, frame.time));
    arrange(frame, film.impact, period.template head<2>() * (Dim == 3 ? 1 : 0), film.diameter);
  }
  return film;
}

template Film film_impact(const Bed<2>&, const Shot&, ImpactRules, const std::vector<double>&);
template Film film_impact(const Bed<3>&, const Shot&, ImpactRules, const std::vector<double>&);

}  // namespace aeolian
