#include "aeolian_core/grains/dynamics/pair_forces.hpp"

#include "aeolian_core/grains/dynamics/pair_meeting.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// One pack of four records as columns.
template <int Dim>
AEOLIAN_INLINE void gather(const GrainRecord<Dim>* grains, const int* numbers, int pack, Lanes* columns) {
  Lanes* const column = columns + 4 * std::ptrdiff_t{pack};
  for (int lane = 0; lane < lane_count; ++lane)
    column[lane] = load_lanes(grains[numbers[lane]].value + 4 * std::ptrdiff_t{pack});
  transpose(column[0], column[1], column[2], column[3]);
}

/// Adds a pack of each of four columns to the loads that `targets` name.
template <int Dim>
AEOLIAN_INLINE void scatter(Lanes* columns, GrainLoad<Dim>* loads, const int* targets, int pack) {
  transpose(columns[0], columns[1], columns[2], columns[3]);
  for (int lane = 0; lane < lane_count; ++lane) {
    double* const load = loads[targets[lane]].value + 4 * std::ptrdiff_t{pack};
    store_lanes(load, load_lanes(load) + columns[lane]);
  }
}

/// So many pairs are looked through before the forces of those that touch are found.
constexpr int block_size = 512;

/// Lists the pairs from `begin` to `end` that touch, and takes the springs off the others.
template <int Dim>
AEOLIAN_INLINE int find_touching(const PairWork<Dim>& work, int begin, int end, int* found) {
  using Record = GrainRecord<Dim>;
  int count = 0;
  for (int at = begin; at < end; at += lane_count) {
    Lanes first[4], second[4];
    gather(work.grains, work.first + at, 0, first);
    gather(work.grains, work.second + at, 0, second);
    Lanes apart[Dim];
    apart_within_period<Dim>(first, second, work.period, apart);
    const Lanes reach = first[Record::radius] + second[Record::radius];
    const auto touching = dot<Dim>(apart, apart) < reach * reach;
    for (int d = 0; d < slip_size<Dim>; ++d)
      store_lanes(work.slip[d] + at, touching ? load_lanes(work.slip[d] + at) : 0.0);
    for (int lane = 0; lane < lane_count; ++lane) {
      found[count] = at + lane;
      count += touching[lane] != 0;
    }
  }
  return count;
}

/// The forces of four pairs, of which the first `count` are there.
template <bool hertz, int Dim>
AEOLIAN_INLINE void add_forces_of(const PairWork<Dim>& work, const int* pairs, int count, Lanes& overlap_most,
                                  Lanes& excess_most) {
  using Record = GrainRecord<Dim>;
  constexpr int slips = slip_size<Dim>;
  int at[lane_count], first_slot[lane_count], second_slot[lane_count], target[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) {
    at[lane] = pairs[lane < count ? lane : 0];
    first_slot[lane] = work.first[at[lane]];
    second_slot[lane] = work.second[at[lane]];
    target[lane] = work.target[at[lane]];
  }
  Lanes first[4 * Record::packs], second[4 * Record::packs], slip[slips];
  for (int pack = 0; pack < Record::packs; ++pack) {
    gather(work.grains, first_slot, pack, first);
    gather(work.grains, second_slot, pack, second);
  }
  for (int d = 0; d < slips; ++d) {
    const double* const from = work.slip[d];
    slip[d] = Lanes{from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
  }

  PairMeeting<Dim, Lanes> pair;
  pair.place(first, second, work.period);
  const auto touching = (pair.meeting.overlap > 0) & (Lanes{0, 1, 2, 3} < static_cast<double>(count));
  overlap_most = larger(overlap_most, pair.meeting.overlap);
  excess_most = larger(excess_most, pair.meeting.overlap - pair.smaller_radius);
  // Pairs that are not there go through the formulae with harmless numbers.
  pair.distance = touching ? pair.distance : 1.0;
  pair.meeting.overlap = touching ? pair.meeting.overlap : 1.0;
  pair.move(first, second, work.dt / 2);
  Answer<Dim, Lanes> force;
  answer<hertz>(work.law, work.dt, pair.meeting, slip, force);
  for (int d = 0; d < slips; ++d) {
    const Lanes kept = touching ? slip[d] : 0.0;
    for (int lane = 0; lane < count; ++lane) work.slip[d][at[lane]] = kept[lane];
  }

  Lanes torque[Record::turns];
  twist<Dim>(pair.meeting.normal, force.shear, torque);
  Lanes on_first[4] = {}, on_second[4] = {};
  for (int d = 0; d < Dim; ++d) {
    on_first[d] = touching ? force.normal * pair.meeting.normal[d] + force.shear[d] : 0.0;
    on_second[d] = -on_first[d];
  }
  if constexpr (Dim == 2) {
    on_first[2] = touching ? torque[0] * pair.arm_first : 0.0;
    on_second[2] = touching ? torque[0] * pair.arm_second : 0.0;
  }
  scatter<Dim>(on_first, work.loads, first_slot, 0);
  scatter<Dim>(on_second, work.loads, target, 0);
  if constexpr (Dim == 3) {
    Lanes turn_first[4] = {}, turn_second[4] = {};
    for (int d = 0; d < 3; ++d) {
      turn_first[d] = touching ? torque[d] * pair.arm_first : 0.0;
      turn_second[d] = touching ? torque[d] * pair.arm_second : 0.0;
    }
    scatter<Dim>(turn_first, work.loads, first_slot, 1);
    scatter<Dim>(turn_second, work.loads, target, 1);
  }
}

template <bool hertz, int Dim>
AEOLIAN_INLINE void add_forces(const PairWork<Dim>& work, int begin, int end, Squeeze& squeeze) {
  Lanes overlap_most = constant<Lanes>(squeeze.overlap);
  Lanes excess_most = constant<Lanes>(squeeze.excess);
  int found[block_size + 1];
  for (int from = begin; from < end; from += block_size) {
    const int count = find_touching(work, from, from + block_size < end ? from + block_size : end, found);
    for (int k = 0; k < count; k += lane_count)
      add_forces_of<hertz>(work, found + k, count - k < lane_count ? count - k : lane_count, overlap_most,
                           excess_most);
  }
  for (int lane = 0; lane < lane_count; ++lane) {
    squeeze.overlap = larger(squeeze.overlap, overlap_most[lane]);
    squeeze.excess = larger(squeeze.excess, excess_most[lane]);
  }
}

AEOLIAN_KERNEL void add_disc_springs(const PairWork<2>& work, int begin, int end, Squeeze& squeeze) {
  add_forces<false>(work, begin, end, squeeze);
}
AEOLIAN_KERNEL void add_disc_hertz(const PairWork<2>& work, int begin, int end, Squeeze& squeeze) {
  add_forces<true>(work, begin, end, squeeze);
}
AEOLIAN_KERNEL void add_sphere_springs(const PairWork<3>& work, int begin, int end, Squeeze& squeeze) {
  add_forces<false>(work, begin, end, squeeze);
}
AEOLIAN_KERNEL void add_sphere_hertz(const PairWork<3>& work, int begin, int end, Squeeze& squeeze) {
  add_forces<true>(work, begin, end, squeeze);
}

}  // namespace

template <>
void add_pair_forces(const PairWork<2>& work, int begin, int end, Squeeze& squeeze) {
  work.law.hertz ? add_disc_hertz(work, begin, end, squeeze) : add_disc_springs(work, begin, end, squeeze);
}

template <>
void add_pair_forces(const PairWork<3>& work, int begin, int end, Squeeze& squeeze) {
  work.law.hertz ? add_sphere_hertz(work, begin, end, squeeze)
                 : add_sphere_springs(work, begin, end, squeeze);
}

}  // namespace aeolian
