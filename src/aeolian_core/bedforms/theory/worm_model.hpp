#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// Haff's worms (Werner 1987, sec. V; specification sec. 4): ripples as worms of whole links on a ring. In
/// each step a worm of l links moves by one with probability pace / l; when it moves and the next does not,
/// it takes that one's last link. A worm without links is gone. A pace of 1 forbids every merger, as the last
/// link always moves. Everything is in links and steps; a pace lies above 0 and not above 1.

/// Probability that the first of two worms on a ring has taken all links or lost them after some steps: the
/// Markov chain of its length, stepped exactly. Throws Error naming what is not allowed.
double merger_probability(int first, int second, double pace, std::int64_t steps);

/// The same by play: how many of `members` independent pairs have merged. Depends on the seed only, whatever
/// the number of threads.
std::int64_t count_mergers(int first, int second, double pace, std::int64_t steps, int members,
                           std::uint64_t seed);

/// Standard deviation of the distance that a lone worm moves while it moves its own length, in parts of that
/// length: sqrt((1 - pace / l) / l).
double worm_fluctuation(int length, double pace);

/// Many worms on one ring.
class WormRing {
 public:
  /// `count` worms of `length` links each. Rings of one seed and different streams are independent. Throws
  /// Error naming what is not allowed.
  WormRing(int count, int length, double pace, std::uint64_t seed, std::uint64_t stream = 0);

  void advance(std::int64_t steps);

  std::int64_t steps() const { return steps_; }
  /// Links of each worm, in order around the ring.
  std::vector<int> lengths() const;
  double mean_length() const;
  double deviation() const;  ///< standard deviation of the lengths

 private:
  struct Worm {
    int length;
    std::int64_t moves_at;  ///< step
  };
  void step();
  void rest(Worm& worm);

  std::vector<Worm> worms_;
  std::vector<std::size_t> moving_;
  std::vector<double> mean_rest_;  ///< by length: -1 / ln(probability that it rests for a step)
  RandomStream random_;
  std::int64_t steps_ = 0;
  int links_;
};

/// One time in the growth of worms.
struct WormGrowth {
  std::int64_t steps;
  double mean_length;
  double deviation;
};
/// The state of a ring at each of some rising times.
std::vector<WormGrowth> grow_worms(WormRing ring, const std::vector<std::int64_t>& times);

/// Slope of the mean length over the logarithm of time, by least squares: 1 in the long run, as mergers at a
/// rate of 1 / length give (Hellen & Krug 2002).
double logarithmic_slope(const std::vector<WormGrowth>& growth);

}  // namespace aeolian
