#include "aeolian_core/grains/dynamics/wall_contact.hpp"

#include <algorithm>

#include "aeolian_core/grains/dynamics/pair_meeting.hpp"

namespace aeolian {

NearestOfWall<2> nearest(const Wall<2>& wall, const Vector<2>& place) {
  const Vector<2> along = wall.to - wall.from;
  const double part = std::clamp((place - wall.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const Vector<2> apart = place - (wall.from + part * along);
  const double distance = apart.norm();
  // A centre on the line is pushed to the left of it.
  if (distance == 0) return {Vector<2>(-along.y(), along.x()).normalized(), 0};
  return {apart / distance, distance};
}

NearestOfWall<3> nearest(const Wall<3>& wall, const Vector<3>& place) {
  return {wall.normal, (place - wall.point).dot(wall.normal)};
}

void move(Wall<2>& wall, double time) {
  wall.from += time * wall.velocity;
  wall.to += time * wall.velocity;
}

void move(Wall<3>& wall, double time) { wall.point += time * wall.velocity; }

template <int Dim>
WallForce<Dim> wall_force(const LawConstants& law, double dt, const Wall<Dim>& wall,
                          const GrainRecord<Dim>& grain, double* slip) {
  using Record = GrainRecord<Dim>;
  using Load = GrainLoad<Dim>;
  using Values = Eigen::Map<const Vector<Dim>>;
  WallForce<Dim> out;
  const double radius = grain.value[Record::radius];
  const NearestOfWall<Dim> near = nearest(wall, Vector<Dim>(Values(grain.value + Record::place)));
  out.overlap = radius - near.distance;
  if (!(out.overlap > 0)) {
    std::fill(slip, slip + slip_size<Dim>, 0.0);
    return out;
  }
  out.touching = true;
  out.normal = near.normal;

  Meeting<Dim, double> meeting;
  meeting.overlap = out.overlap;
  meeting.mass = 1 / grain.value[Record::inverse_mass];
  meeting.radius = radius;
  double arms_midway[Record::turns], arms[Record::turns];
  for (int d = 0; d < Record::turns; ++d) {
    arms_midway[d] = near.distance * grain.value[Record::spin + d];
    arms[d] = arms_midway[d] + dt / 2 * near.distance * grain.value[Record::turning + d];
  }
  for (int d = 0; d < Dim; ++d) {
    meeting.normal[d] = near.normal[d];
    meeting.midway[d] = grain.value[Record::velocity + d] - wall.velocity[d];
    meeting.velocity[d] = meeting.midway[d] + dt / 2 * grain.value[Record::acceleration + d];
  }
  add_turning<Dim>(meeting.normal, arms_midway, meeting.midway);
  add_turning<Dim>(meeting.normal, arms, meeting.velocity);

  Answer<Dim, double> force;
  law.hertz ? answer<true>(law, dt, meeting, slip, force) : answer<false>(law, dt, meeting, slip, force);
  double torque[Record::turns];
  twist<Dim>(meeting.normal, force.shear, torque);
  out.normal_force = force.normal;
  for (int d = 0; d < Dim; ++d) {
    out.shear[d] = force.shear[d];
    out.load.value[d] = force.normal * meeting.normal[d] + force.shear[d];
  }
  for (int d = 0; d < Record::turns; ++d) out.load.value[Load::torque + d] = near.distance * torque[d];
  return out;
}

template WallForce<2> wall_force(const LawConstants&, double, const Wall<2>&, const GrainRecord<2>&, double*);
template WallForce<3> wall_force(const LawConstants&, double, const Wall<3>&, const GrainRecord<3>&, double*);

}  // namespace aeolian
