#pragma once

#include <cstdint>
#include <unordered_map>

#include "aeolian_core/slide/mpm/particle_block.hpp"

namespace aeolian {

/// Finds the number of a block by its place.
template <int Dim>
class BlockIndex {
 public:
  static constexpr int farthest = 1 << 20;  ///< blocks from the origin along an axis

  void clear() { numbers_.clear(); }
  void set(const BlockPlace<Dim>& place, int number) { numbers_[key(place)] = number; }
  /// -1 where there is none.
  int find(const BlockPlace<Dim>& place) const {
    const auto found = numbers_.find(key(place));
    return found == numbers_.end() ? -1 : found->second;
  }
  /// The number under which it is known; when it is new, it becomes `number`.
  int find_or_set(const BlockPlace<Dim>& place, int number) {
    return numbers_.emplace(key(place), number).first->second;
  }

 private:
  static std::uint64_t key(const BlockPlace<Dim>& place) {
    std::uint64_t result = 0;
    for (const int at : place) result = (result << 21) | static_cast<std::uint64_t>(at + farthest);
    return result;
  }

  std::unordered_map<std::uint64_t, int> numbers_;
};

}  // namespace aeolian
