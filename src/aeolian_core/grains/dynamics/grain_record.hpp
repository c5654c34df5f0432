#pragma once

namespace aeolian {

/// What a step needs of one grain, side by side in packs of four numbers: a pair of grains is then a few
/// loads, and four pairs are turned into structure-of-arrays form in registers.
template <int Dim>
struct GrainRecord;

/// Two packs of motion and one of acceleration; `inverse_inertia` and `spin` follow the velocity.
template <>
struct GrainRecord<2> {
  static constexpr int packs = 3, turns = 1;
  static constexpr int place = 0, radius = 2, inverse_mass = 3;
  static constexpr int velocity = 4, spin = 6, inverse_inertia = 7;
  static constexpr int acceleration = 8, turning = 10;
  alignas(32) double value[4 * packs] = {};
};

template <>
struct GrainRecord<3> {
  static constexpr int packs = 5, turns = 3;
  static constexpr int place = 0, radius = 3;
  static constexpr int velocity = 4, inverse_mass = 7, spin = 8, inverse_inertia = 11;
  static constexpr int acceleration = 12, turning = 16;
  alignas(32) double value[4 * packs] = {};
};

/// Force and torque on one grain, in the order of acceleration and turning in its record.
template <int Dim>
struct GrainLoad {
  static constexpr int packs = Dim - 1, torque = Dim == 2 ? 2 : 4;
  alignas(32) double value[4 * packs] = {};
};

/// The stored shear displacement of a contact: along the tangent in two dimensions, a vector in three [m].
template <int Dim>
constexpr int slip_size = Dim == 2 ? 1 : 3;

}  // namespace aeolian
