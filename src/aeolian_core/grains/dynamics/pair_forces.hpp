#pragma once

#include <limits>

#include "aeolian_core/grains/dynamics/contact_force.hpp"
#include "aeolian_core/grains/dynamics/grain_record.hpp"

namespace aeolian {

/// Pairs that may touch, as plain arrays of a length that is a multiple of lane_count; filled up with pairs
/// of record 0, which is no grain.
template <int Dim>
struct PairWork {
  const LawConstants& law;
  double period[Dim];  ///< infinite where there is none [m]
  double dt;           ///< how long the shear springs were stretched [s]
  const GrainRecord<Dim>* grains;
  const int* first;
  const int* second;
  const int* target;             ///< which load takes the second grain's force
  double* slip[slip_size<Dim>];  ///< kept from step to step; zero where a pair does not touch
  GrainLoad<Dim>* loads;         ///< forces and torques are added
};

/// How far grains have been pressed together.
struct Squeeze {
  double overlap = 0;                                        ///< the largest [m]
  double excess = -std::numeric_limits<double>::infinity();  ///< over the smaller radius [m]
};

/// The forces of the pairs from `begin` to `end`, in their order.
template <int Dim>
void add_pair_forces(const PairWork<Dim>& work, int begin, int end, Squeeze& squeeze);

}  // namespace aeolian
