#pragma once

#include <vector>

#include "aeolian_core/grains/dynamics/grain_record.hpp"

namespace aeolian {

/// Two grains that may touch, the lower slot first, and the shear spring between them.
template <int Dim>
struct NearPair {
  int first, second;
  double slip[slip_size<Dim>] = {};
};

template <int Dim>
bool operator<(const NearPair<Dim>& a, const NearPair<Dim>& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// So many neighbouring slots are one piece of work, whatever the number of threads.
constexpr int slots_per_chunk = 256;
constexpr int chunk_of(int slot) { return slot / slots_per_chunk; }

/// The pairs as the force kernel wants them: plain arrays, by the chunk of the first grain. A second grain in
/// another chunk has its force put into a load of its own, which that chunk fetches (`Fetch`): chunks can be
/// worked on side by side, and sums do not depend on who comes first.
template <int Dim>
class ContactList {
 public:
  struct Fetch {
    int slot, load;
  };

  /// `pairs` ascend.
  void assign(const std::vector<NearPair<Dim>>& pairs, int slots);
  /// The pairs with their springs as they are now, ascending.
  std::vector<NearPair<Dim>> pairs() const;
  /// Those of one slot, added to `pairs`.
  void copy(int slot, std::vector<NearPair<Dim>>& pairs) const;
  /// Adds others, ascending and new.
  void insert(const std::vector<NearPair<Dim>>& others, int slots);

  int chunks() const { return static_cast<int>(begin_.size()) - 1; }
  int begin(int chunk) const { return begin_[static_cast<std::size_t>(chunk)]; }
  int end(int chunk) const { return begin_[static_cast<std::size_t>(chunk) + 1]; }
  const Fetch* fetch_begin(int chunk) const {
    return fetches_.data() + fetch_begin_[static_cast<std::size_t>(chunk)];
  }
  const Fetch* fetch_end(int chunk) const {
    return fetches_.data() + fetch_begin_[static_cast<std::size_t>(chunk) + 1];
  }
  int loads() const { return loads_; }  ///< one for each slot and each fetch

  const int* first() const { return now_.first.data(); }
  const int* second() const { return now_.second.data(); }
  const int* target() const { return now_.target.data(); }
  double* slip(int axis) { return now_.slip[axis].data(); }

 private:
  struct Columns {
    std::vector<int> first, second, target;
    std::vector<double> slip[slip_size<Dim>];

    void resize(std::size_t size);
  };

  void sort_fetches(int chunks);
  NearPair<Dim> pair(std::size_t at) const;

  Columns now_, before_;  // the latter is memory to build the next list in
  std::vector<int> begin_ = {0}, fetch_begin_ = {0};
  std::vector<Fetch> fetches_;
  int loads_ = 0;
};

}  // namespace aeolian
