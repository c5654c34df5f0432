#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace aeolian {

/// A periodic surface of steps up and down by one, a bit for each: set where the surface rises from a place
/// to the next. A summit is a place between a rise and a fall, a pocket one between a fall and a rise. Places
/// are 0 to `count` - 1. Searches look at 64 steps at once.
class StepRing {
 public:
  static constexpr int none = -1;

  /// Level: rises and falls take turns. The number of steps is a multiple of 64.
  explicit StepRing(int count)
      : count_(count), words_(static_cast<std::size_t>(count) / 64 + 2 * margin, 0x5555555555555555U) {}

  /// Brings a place at most `count` outside back.
  int inside(int at) const { return at < 0 ? at + count_ : at >= count_ ? at - count_ : at; }
  bool rises(int at) const { return (word(at) >> at % 64 & 1U) != 0; }
  void flip(int step) {
    change(step, std::uint64_t{1} << step % 64);
    if (step < 64) change(step + count_, std::uint64_t{1} << step % 64);
    if (step >= count_ - 64) change(step - count_, std::uint64_t{1} << step % 64);
  }
  /// A summit becomes a pocket two layers lower, or a pocket a summit two layers higher.
  void turn(int at) {
    if (at % 64 > 0 && at >= 64 && at < count_ - 64) {
      change(at, std::uint64_t{3} << (at % 64 - 1));
    } else {
      flip(at);
      flip(inside(at - 1));
    }
  }

  /// The summit that is reached by going up from a place.
  int summit(int at) const {
    std::uint64_t steps = from(at - 1);
    for (; (steps | 1U) == ~std::uint64_t{0}; steps = from(at - 1)) at = inside(at + 63);
    if ((steps & 3U) == 0) {
      // No rise ahead: up means back.
      std::uint64_t behind = up_to(at);
      for (; behind == 0; behind = up_to(at)) at = inside(at - 63);
      return inside(at + 1 - last(behind));
    }
    return inside(at + first(~(steps >> 1)));
  }
  /// The first pocket at a place or beyond it. There must be one.
  int pocket_from(int at) const {
    while (true) {
      const std::uint64_t steps = from(at - 1);
      if (const std::uint64_t pockets = ~steps & steps >> 1) return inside(at + first(pockets));
      at = inside(at + 63);
    }
  }
  /// The last pocket at a place or before it.
  int pocket_up_to(int at) const {
    while (true) {
      const std::uint64_t steps = up_to(at);
      if (const std::uint64_t pockets = ~(steps << 1) & steps & ~std::uint64_t{1})
        return inside(at - last(pockets));
      at = inside(at - 63);
    }
  }
  /// The first summit at a place or beyond it that two falls follow; `none` within `range`.
  int brink_from(int at, int range) const {
    for (; range >= 0; range -= 62, at = inside(at + 62)) {
      const std::uint64_t steps = from(at - 1);
      if (const std::uint64_t brinks = steps & ~(steps >> 1) & ~(steps >> 2) & ~std::uint64_t{0} >> 2)
        return first(brinks) <= range ? inside(at + first(brinks)) : none;
    }
    return none;
  }
  /// The last summit at a place or before it that two rises lead up to; `none` within `range`.
  int brink_up_to(int at, int range) const {
    for (; range >= 0; range -= 62, at = inside(at - 62)) {
      const std::uint64_t steps = up_to(at);
      if (const std::uint64_t brinks = ~steps & steps << 1 & steps << 2)
        return last(brinks) <= range ? inside(at - last(brinks)) : none;
    }
    return none;
  }

 private:
  static constexpr std::size_t margin = 1;  ///< words of the other end that are kept at either end as well

  static int first(std::uint64_t bits) { return __builtin_ctzll(bits); }
  /// Places before the last one of 64.
  static int last(std::uint64_t bits) { return __builtin_clzll(bits); }

  static std::size_t bit(int at) { return static_cast<std::size_t>(at) + 64 * margin; }
  std::uint64_t word(int at) const { return words_[bit(at) / 64]; }
  /// The steps of a place, in bit 0, and those after it.
  std::uint64_t from(int at) const {
    const std::uint64_t* const here = &words_[bit(at) / 64];
    return here[0] >> bit(at) % 64 | here[1] << 1 << (63 - bit(at) % 64);
  }
  /// The steps of a place, in bit 63, and those before it.
  std::uint64_t up_to(int at) const { return from(at - 63); }

  void change(int step, std::uint64_t bits) { words_[bit(step) / 64] ^= bits; }

  int count_;
  std::vector<std::uint64_t> words_;
};

}  // namespace aeolian
