#pragma once

#include <vector>

#include "aeolian_core/grains/dynamics/contact_list.hpp"

namespace aeolian {

/// The pairs that both sleep, by slot: to wake a grain costs what its own pairs cost, however many sleep.
template <int Dim>
class RestingPairs {
 public:
  void clear() { partners_.clear(); }
  void add(const NearPair<Dim>& pair);
  /// Moves those of a slot to the end of `pairs`, in no order.
  void take(int slot, std::vector<NearPair<Dim>>& pairs);
  /// Adds those of a slot to `pairs`, in no order.
  void copy(int slot, std::vector<NearPair<Dim>>& pairs) const;
  /// All, added to `pairs`, by the first slot.
  void copy(std::vector<NearPair<Dim>>& pairs) const;

 private:
  struct Partner {
    int slot;
    double slip[slip_size<Dim>];
  };

  static NearPair<Dim> pair_of(int slot, const Partner& partner);

  std::vector<std::vector<Partner>> partners_;  // each pair is noted at both of its slots
};

}  // namespace aeolian
