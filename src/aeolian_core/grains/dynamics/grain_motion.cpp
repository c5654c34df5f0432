#include "aeolian_core/grains/dynamics/grain_motion.hpp"

#include "aeolian_core/surface/kernel.hpp"
#include "aeolian_core/surface/lanes.hpp"

namespace aeolian {
namespace {

template <int Dim>
AEOLIAN_INLINE double squares(const Lanes& a) {
  return Dim == 2 ? a[0] * a[0] + a[1] * a[1] : a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

/// A number for each axis, nothing for what else a pack holds.
template <int Dim>
AEOLIAN_INLINE Lanes axes(double value) {
  return Lanes{value, value, Dim == 3 ? value : 0, 0};
}

template <int Dim>
AEOLIAN_INLINE bool move(GrainRecord<Dim>* grains, const Anchor* anchors, const int* slots, int count,
                         double dt) {
  using Record = GrainRecord<Dim>;
  const Lanes way = axes<Dim>(dt);
  bool used_up = false;
  for (int k = 0; k < count; ++k) {
    double* const value = grains[slots[k]].value;
    const Lanes velocity =
        load_lanes(value + Record::velocity) + dt / 2 * load_lanes(value + Record::acceleration);
    const Lanes place = load_lanes(value) + way * velocity;
    store_lanes(value + Record::velocity, velocity);
    store_lanes(value, place);
    if constexpr (Dim == 3)
      store_lanes(value + Record::spin,
                  load_lanes(value + Record::spin) + dt / 2 * load_lanes(value + Record::turning));
    const Anchor& anchor = anchors[slots[k]];
    used_up |= squares<Dim>(place - load_lanes(anchor.place)) > anchor.skin * anchor.skin;
  }
  return used_up;
}

/// New rates of a pack of velocities, which ends with a number to be left alone.
AEOLIAN_INLINE void push(double* velocity, double* rate, const Lanes& pushed, const Lanes& drag,
                         double half) {
  const Lanes midway = load_lanes(velocity);
  const Lanes rates = pushed - drag * (midway + half * load_lanes(rate));
  store_lanes(rate, rates);
  store_lanes(velocity, midway + half * rates);
}

template <int Dim>
AEOLIAN_INLINE void kick(const KickWork<Dim>& work, const int* slots, int count, Liveliest& liveliest) {
  using Record = GrainRecord<Dim>;
  const double half = work.dt / 2, slow = work.slow * work.slow, dt = work.dt;
  const Lanes gravity = Lanes{work.gravity[0], work.gravity[1], work.gravity[2], 0};
  const Lanes drag = Lanes{work.drag, work.drag, work.drag, 0};
  for (int k = 0; k < count; ++k) {
    double* const value = work.grains[slots[k]].value;
    double* const load = work.loads[slots[k]].value;
    const double inverse_mass = value[Record::inverse_mass];
    const double inverse_inertia = value[Record::inverse_inertia];
    double turning = 0;  // speed of the surface, squared
    const double radius = value[Record::radius];
    if constexpr (Dim == 2) {
      const Lanes inverse = Lanes{inverse_mass, inverse_mass, inverse_inertia, 0};
      push(value + Record::velocity, value + Record::acceleration, load_lanes(load) * inverse + gravity, drag,
           half);
      store_lanes(load, Lanes{});
      turning = value[Record::spin] * value[Record::spin] * radius * radius;
    } else {
      push(value + Record::velocity, value + Record::acceleration,
           load_lanes(load) * axes<3>(inverse_mass) + gravity, drag, half);
      push(value + Record::spin, value + Record::turning, load_lanes(load + 4) * axes<3>(inverse_inertia),
           drag, half);
      store_lanes(load, Lanes{});
      store_lanes(load + 4, Lanes{});
      turning = squares<3>(load_lanes(value + Record::spin)) * radius * radius;
    }
    const double speed = squares<Dim>(load_lanes(value + Record::velocity));
    liveliest.speed = larger(liveliest.speed, speed);
    liveliest.acceleration =
        larger(liveliest.acceleration, squares<Dim>(load_lanes(value + Record::acceleration)));
    double& rest = work.rest[slots[k]];
    rest = speed < slow && turning < slow ? rest + dt : 0;
  }
}

AEOLIAN_KERNEL bool move_discs(GrainRecord<2>* grains, const Anchor* anchors, const int* slots, int count,
                               double dt) {
  return move<2>(grains, anchors, slots, count, dt);
}
AEOLIAN_KERNEL bool move_spheres(GrainRecord<3>* grains, const Anchor* anchors, const int* slots, int count,
                                 double dt) {
  return move<3>(grains, anchors, slots, count, dt);
}
AEOLIAN_KERNEL void kick_discs(const KickWork<2>& work, const int* slots, int count, Liveliest& liveliest) {
  kick<2>(work, slots, count, liveliest);
}
AEOLIAN_KERNEL void kick_spheres(const KickWork<3>& work, const int* slots, int count, Liveliest& liveliest) {
  kick<3>(work, slots, count, liveliest);
}

}  // namespace

template <>
bool move_grains(GrainRecord<2>* grains, const Anchor* anchors, const int* slots, int count, double dt) {
  return move_discs(grains, anchors, slots, count, dt);
}
template <>
bool move_grains(GrainRecord<3>* grains, const Anchor* anchors, const int* slots, int count, double dt) {
  return move_spheres(grains, anchors, slots, count, dt);
}
template <>
void kick_grains(const KickWork<2>& work, const int* slots, int count, Liveliest& liveliest) {
  kick_discs(work, slots, count, liveliest);
}
template <>
void kick_grains(const KickWork<3>& work, const int* slots, int count, Liveliest& liveliest) {
  kick_spheres(work, slots, count, liveliest);
}

}  // namespace aeolian
