#include "aeolian_core/bedforms/theory/worm_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "aeolian_core/bedforms/theory/independent_members.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw Error("worms: " + what);
}

void check_pace(double pace) {
  require(pace > 0 && pace <= 1, "pace is " + std::to_string(pace) + ", must be above 0 and not above 1");
}

void check_pair(int first, int second, double pace, std::int64_t steps) {
  check_pace(pace);
  require(first > 0 && second > 0, "lengths of a pair are " + std::to_string(first) + " and " +
                                       std::to_string(second) + ", must be at least 1");
  require(steps >= 0, std::to_string(steps) + " steps, must not be negative");
}

/// By length: a worm moves when 32 random bits lie below this.
std::vector<std::uint64_t> move_thresholds(int links, double pace) {
  std::vector<std::uint64_t> result(static_cast<std::size_t>(links) + 1);
  for (int l = 1; l <= links; ++l)
    result[static_cast<std::size_t>(l)] = static_cast<std::uint64_t>(std::llround(0x1p32 * pace / l));
  return result;
}

/// Whether a pair has merged.
bool play_pair(std::size_t first, std::size_t second, const std::vector<std::uint64_t>& moves_below,
               std::int64_t steps, RandomStream random) {
  for (std::int64_t n = 0; n < steps && first > 0 && second > 0; ++n) {
    const bool first_moves = random.bits() < moves_below[first];
    const bool second_moves = random.bits() < moves_below[second];
    first += static_cast<std::size_t>(first_moves) - static_cast<std::size_t>(second_moves);
    second = moves_below.size() - 1 - first;
  }
  return first == 0 || second == 0;
}

}  // namespace

double merger_probability(int first, int second, double pace, std::int64_t steps) {
  check_pair(first, second, pace, steps);
  const int links = first + second;
  std::vector<double> now(static_cast<std::size_t>(links) + 1, 0.0);
  now[static_cast<std::size_t>(first)] = 1;
  for (std::int64_t n = 0; n < steps; ++n) {
    std::vector<double> next(now.size(), 0.0);
    next.front() = now.front();
    next.back() = now.back();
    for (std::size_t i = 1; i + 1 < now.size(); ++i) {
      const double moves = pace / static_cast<double>(i);
      const double other_moves = pace / static_cast<double>(now.size() - 1 - i);
      const double shrinks = other_moves * (1 - moves);
      const double grows = moves * (1 - other_moves);
      next[i - 1] += shrinks * now[i];
      next[i + 1] += grows * now[i];
      next[i] += (1 - shrinks - grows) * now[i];
    }
    now.swap(next);
  }
  return now.front() + now.back();
}

std::int64_t count_mergers(int first, int second, double pace, std::int64_t steps, int members,
                           std::uint64_t seed) {
  check_pair(first, second, pace, steps);
  require(members > 0, std::to_string(members) + " members, must be at least 1");
  const std::vector<std::uint64_t> moves_below = move_thresholds(first + second, pace);
  const std::vector<int> merged = run_members(members, [&](int member) {
    return static_cast<int>(play_pair(static_cast<std::size_t>(first), static_cast<std::size_t>(second),
                                      moves_below, steps,
                                      RandomStream(seed, static_cast<std::uint64_t>(member))));
  });
  return std::accumulate(merged.begin(), merged.end(), std::int64_t{0});
}

double worm_fluctuation(int length, double pace) {
  check_pace(pace);
  require(length > 0, "a length of " + std::to_string(length) + ", must be at least 1");
  return std::sqrt((1 - pace / length) / length);
}

WormRing::WormRing(int count, int length, double pace, std::uint64_t seed, std::uint64_t stream)
    : random_(seed, stream), links_(0) {
  check_pace(pace);
  constexpr int most = 10'000'000;
  require(count > 0 && length > 0 && count <= most / length,
          std::to_string(count) + " worms of " + std::to_string(length) +
              " links, must be at least one of one and not above " + std::to_string(most) + " links in all");
  links_ = count * length;
  mean_rest_.push_back(0);
  for (int l = 1; l <= links_; ++l) mean_rest_.push_back(-1 / std::log1p(-pace / l));
  for (int i = 0; i < count; ++i) worms_.push_back({length, 0});
  for (Worm& worm : worms_) rest(worm);
}

void WormRing::advance(std::int64_t steps) {
  for (std::int64_t n = 0; n < steps; ++n) step();
}

/// Draws when a worm moves next. It forgets how long it has rested, so that this may be drawn anew when its
/// length changes.
void WormRing::rest(Worm& worm) {
  const double rests = random_.exponential() * mean_rest_[static_cast<std::size_t>(worm.length)];
  worm.moves_at = steps_ + 1 + static_cast<std::int64_t>(rests);
}

void WormRing::step() {
  ++steps_;
  bool starved = false;
  moving_.clear();
  for (std::size_t i = 0; i < worms_.size(); ++i)
    if (worms_[i].moves_at == steps_) moving_.push_back(i);
  // Whether the next one moves, too, must not be forgotten before it is asked: all rest afterwards.
  for (const std::size_t i : moving_) {
    Worm& next = worms_[i + 1 < worms_.size() ? i + 1 : 0];
    if (next.moves_at == steps_) continue;
    ++worms_[i].length;
    --next.length;
    if (next.length > 0) rest(next);
    starved |= next.length == 0;
  }
  for (const std::size_t i : moving_) rest(worms_[i]);
  if (starved)
    worms_.erase(
        std::remove_if(worms_.begin(), worms_.end(), [](const Worm& worm) { return worm.length == 0; }),
        worms_.end());
}

std::vector<int> WormRing::lengths() const {
  std::vector<int> result;
  for (const Worm& worm : worms_) result.push_back(worm.length);
  return result;
}

double WormRing::mean_length() const {
  return static_cast<double>(links_) / static_cast<double>(worms_.size());
}

double WormRing::deviation() const {
  const double mean = mean_length();
  double square = 0;
  for (const Worm& worm : worms_) square += (worm.length - mean) * (worm.length - mean);
  return std::sqrt(square / static_cast<double>(worms_.size()));
}

std::vector<WormGrowth> grow_worms(WormRing ring, const std::vector<std::int64_t>& times) {
  std::vector<WormGrowth> result;
  for (const std::int64_t time : times) {
    require(time >= ring.steps(),
            "times must rise, " + std::to_string(time) + " follows " + std::to_string(ring.steps()));
    ring.advance(time - ring.steps());
    result.push_back({time, ring.mean_length(), ring.deviation()});
  }
  return result;
}

double logarithmic_slope(const std::vector<WormGrowth>& growth) {
  double x = 0, y = 0;
  for (const WormGrowth& g : growth) {
    x += std::log(static_cast<double>(g.steps)) / static_cast<double>(growth.size());
    y += g.mean_length / static_cast<double>(growth.size());
  }
  double xy = 0, xx = 0;
  for (const WormGrowth& g : growth) {
    const double dx = std::log(static_cast<double>(g.steps)) - x;
    xy += dx * (g.mean_length - y);
    xx += dx * dx;
  }
  return xy / xx;
}

}  // namespace aeolian
