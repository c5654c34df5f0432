#include "aeolian_core/grains/pair_forces.hpp"

#include "aeolian_core/grains/pair_meeting.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// One pack of four records as columns.
template <int Dim>
AEOLIAN_INLINE void gather(const GrainRecord<Dim>* grains, const int* numbers, int pack, Lanes* columns) {
  Lanes* const column = columns + 4 * pack;
  for (int lane = 0; lane < lane_count; ++lane)
    column[lane] = load_lanes(grains[numbers[lane]].value + 4 * pack);
  transpose(column[0], column[1], column[2], column[3]);
}

/// Adds a pack of each of four columns to the loads that `targets` name.
template <int Dim>
AEOLIAN_INLINE void scatter(Lanes* columns, GrainLoad<Dim>* loads, const int* targets, int pack) {
  transpose(columns[0], columns[1], columns[2], columns[3]);
  for (int lane = 0; lane < lane_count; ++lane) {
    double* const load = loads[targets[lane]].value + 4 * pack;
    store_lanes(load, load_lanes(load) + columns[lane]);
  }
}

template <bool hertz, int Dim>
AEOLIAN_INLINE void add_forces(const PairWork<Dim>& work, int begin, int end, Squeeze& squeeze) {
  using Record = GrainRecord<Dim>;
  constexpr int slips = slip_size<Dim>;
  const LawConstants law = work.law;
  Lanes overlap_most = constant<Lanes>(squeeze.overlap);
  Lanes excess_most = constant<Lanes>(squeeze.excess);
  for (int at = begin; at < end; at += lane_count) {
    Lanes first[4 * Record::packs], second[4 * Record::packs];
    gather(work.grains, work.first + at, 0, first);
    gather(work.grains, work.second + at, 0, second);
    PairMeeting<Dim, Lanes> pair;
    pair.place(first, second, work.period);
    const auto touching = pair.meeting.overlap > 0;
    if (!(touching[0] | touching[1] | touching[2] | touching[3])) {
      for (int d = 0; d < slips; ++d) store_lanes(work.slip[d] + at, Lanes{});
      continue;
    }
    for (int pack = 1; pack < Record::packs; ++pack) {
      gather(work.grains, work.first + at, pack, first);
      gather(work.grains, work.second + at, pack, second);
    }
    overlap_most = larger(overlap_most, pair.meeting.overlap);
    excess_most = larger(excess_most, pair.meeting.overlap - pair.smaller_radius);

    // Pairs that are apart go through the formulae with harmless numbers.
    pair.distance = touching ? pair.distance : 1.0;
    pair.meeting.overlap = touching ? pair.meeting.overlap : 1.0;
    pair.move(first, second, work.dt / 2);
    Lanes slip[slips];
    for (int d = 0; d < slips; ++d) slip[d] = load_lanes(work.slip[d] + at);
    Answer<Dim, Lanes> force;
    answer<hertz>(law, work.dt, pair.meeting, slip, force);
    for (int d = 0; d < slips; ++d) store_lanes(work.slip[d] + at, touching ? slip[d] : 0.0);

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
    scatter<Dim>(on_first, work.loads, work.first + at, 0);
    scatter<Dim>(on_second, work.loads, work.target + at, 0);
    if constexpr (Dim == 3) {
      Lanes turn_first[4] = {}, turn_second[4] = {};
      for (int d = 0; d < 3; ++d) {
        turn_first[d] = touching ? torque[d] * pair.arm_first : 0.0;
        turn_second[d] = touching ? torque[d] * pair.arm_second : 0.0;
      }
      scatter<Dim>(turn_first, work.loads, work.first + at, 1);
      scatter<Dim>(turn_second, work.loads, work.target + at, 1);
    }
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
