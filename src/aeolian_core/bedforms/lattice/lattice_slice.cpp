#include "aeolian_core/bedforms/lattice/lattice_slice.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/kernel.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"lattice slice"};

void check(const SliceParameters& p) {
  require(p.columns >= 64 && p.columns <= 1'000'000 && p.columns % 64 == 0, "number of columns", p.columns,
          "a multiple of 64, at most a million");
  require(p.impact_angle >= 0.02 && p.impact_angle <= 1.4, "impact angle [rad]", p.impact_angle,
          "from 0.02 to 1.4");
  require(p.forward >= 1, "forward reptation length", p.forward, "1 or more half-spacings");
  require(p.backward >= 1, "backward reptation length", p.backward, "1 or more half-spacings");
  require(p.brink_share >= 0 && p.brink_share <= 1, "share of brink ejections", p.brink_share, "from 0 to 1");
  require(p.brink_range >= 0, "range of the search for a brink", p.brink_range, "0 or more half-spacings");
  require(p.hits_per_point >= 1, "number of hits per point", p.hits_per_point, "1 or more");
}

/// Columns are searched for the first contact this many at a time.
constexpr int block = 16;

using Four = int __attribute__((vector_size(16)));

AEOLIAN_INLINE Four load(const int* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

/// The first of a block of columns that reaches above a ray, `block` if none does.
AEOLIAN_INLINE int first_above(const int* reach, int ray) {
  const Four bits = ((load(reach) > ray) & Four{1, 2, 4, 8}) |
                    ((load(reach + 4) > ray) & Four{1 << 4, 1 << 5, 1 << 6, 1 << 7}) |
                    ((load(reach + 8) > ray) & Four{1 << 8, 1 << 9, 1 << 10, 1 << 11}) |
                    ((load(reach + 12) > ray) & Four{1 << 12, 1 << 13, 1 << 14, 1 << 15});
  return __builtin_ctz(static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]) | 1U << block);
}

/// Where the search for a contact starts is found anew after so many points per column.
constexpr int starts_hold = 4;

/// Intercepts are gathered in buckets as long as the fall of a grain over one to two times as many columns.
constexpr int columns_per_bucket = 8;

std::vector<int> flat(int columns) {
  std::vector<int> heights(static_cast<std::size_t>(std::max(0, columns)));
  for (std::size_t i = 1; i < heights.size(); i += 2) heights[i] = 1;
  return heights;
}

}  // namespace

LatticeSlice::LatticeSlice(const SliceParameters& parameters, std::uint64_t seed, std::uint64_t stream)
    : LatticeSlice(parameters, flat(parameters.columns), seed, stream) {}

LatticeSlice::LatticeSlice(const SliceParameters& parameters, const std::vector<int>& heights,
                           std::uint64_t seed, std::uint64_t stream)
    : parameters_(parameters),
      philox_(seed),
      stream_(stream),
      random_(seed, ~stream),
      steps_((check(parameters), parameters.columns)) {
  if (heights.size() != static_cast<std::size_t>(parameters.columns))
    throw Error("lattice slice: " + std::to_string(heights.size()) + " heights for " +
                std::to_string(parameters.columns) + " columns");
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const int next = heights[(i + 1) % heights.size()];
    if (std::abs(heights[i] - next) != 1 || std::abs(heights[i]) % 2 != static_cast<int>(i % 2))
      throw Error("lattice slice: column " + std::to_string(i) + " is " + std::to_string(heights[i]) +
                  " layers high, the next " + std::to_string(next) +
                  "; they must be one apart, and even columns even");
    if (steps_.rises(static_cast<int>(i)) != (next > heights[i])) steps_.flip(static_cast<int>(i));
  }

  // In units of a layer, d/2: a column is sqrt(3) layers long. The centre of a falling grain that just
  // touches a summit's top passes d = 2 / cos(angle) layers above its centre; one that rests on it and on the
  // next higher grain stands 2 layers above it, and so does the limit between both sides of a grain. Above
  // 60 degrees the path touches the next lower grain before it would pass the summit.
  const double drop = std::sqrt(3.0) * std::tan(parameters.impact_angle);
  const double over_top =
      parameters.impact_angle < M_PI / 3 ? 2 / std::cos(parameters.impact_angle) - 2 : drop - 1;
  unit_ = 1 << 20;
  while (unit_ * (parameters.columns * (drop + 1) + over_top) > std::numeric_limits<int>::max() / 4.0)
    unit_ /= 2;
  drop_ = static_cast<std::uint64_t>(std::llround(drop * unit_ * 0x1p32));
  over_top_ = static_cast<int>(std::lround(over_top * unit_));
  period_ = fall_to(parameters.columns);
  while (drop * unit_ * columns_per_bucket > 1 << (bucket_bits_ + 1)) ++bucket_bits_;
  start_.resize((static_cast<std::size_t>(period_) >> bucket_bits_) + 2, std::numeric_limits<int>::min());
  datum_ = heights[0];
  for (int i = 0; i < parameters.columns; ++i)
    reach_.push_back((heights[static_cast<std::size_t>(i)] - datum_) * unit_ + fall_to(i) + over_top_);
  reach_.resize(reach_.size() + block, std::numeric_limits<int>::max());
  find_starts();
}

/// From column 0 to another.
int LatticeSlice::fall_to(int column) const {
  return static_cast<int>(static_cast<std::uint64_t>(column) * drop_ >> 32);
}

std::vector<int> LatticeSlice::heights() const {
  std::vector<int> result{datum_ + (reach_[0] - over_top_) / unit_};
  for (int i = 1; i < parameters_.columns; ++i)
    result.push_back(result.back() + (steps_.rises(i - 1) ? 1 : -1));
  return result;
}

std::vector<double> LatticeSlice::elevation() const {
  std::vector<double> result;
  for (const int height : heights()) result.push_back(layer * height);
  return result;
}

double LatticeSlice::ejections_per_surface_grain() const {
  const int surface_grains = parameters_.columns / 2;
  return static_cast<double>(counts_.ejections()) / surface_grains;
}

/// Finds the starts from the envelope, the highest reach of all columns before each.
void LatticeSlice::find_starts() {
  since_starts_ = 0;
  // Shadows of the repetitions upwind fall on the bed as well.
  const int repetitions = (*std::max_element(reach_.begin(), reach_.end() - block) - 1) / period_;
  std::size_t bucket = 1;
  int from = 0;  // of the intercepts of the bucket
  for (int n = -repetitions; n <= 0; ++n)
    for (int i = 0; i < parameters_.columns; ++i)
      for (; from < std::min(period_, reach_[static_cast<std::size_t>(i)] + n * period_);
           from += 1 << bucket_bits_)
        start_[bucket++] = n * parameters_.columns + i;
  std::fill(start_.begin() + static_cast<std::ptrdiff_t>(bucket), start_.end(), parameters_.columns);
}

/// A column has come to reach farther.
AEOLIAN_INLINE void LatticeSlice::advance_starts(int column) {
  const int reach = reach_[static_cast<std::size_t>(column)];
  auto bucket = static_cast<std::size_t>(reach >> bucket_bits_) + 1;  // far beyond all below 0
  if (bucket >= start_.size() - 1) return advance_starts_around(column);
  for (; start_[bucket] > column; --bucket) start_[bucket] = column;
}

/// The same where the shadow reaches from one end of the bed to the other.
void LatticeSlice::advance_starts_around(int column) {
  for (int reach = reach_[static_cast<std::size_t>(column)]; reach > 0;
       reach -= period_, column -= parameters_.columns)
    for (std::size_t bucket =
             std::min(static_cast<std::size_t>(reach >> bucket_bits_) + 1, start_.size() - 1);
         start_[bucket] > column; --bucket)
      start_[bucket] = column;
}

AEOLIAN_INLINE LatticeSlice::Contact LatticeSlice::first_contact(int ray) const {
  const int columns = parameters_.columns;
  int column = start_[static_cast<std::size_t>(ray >> bucket_bits_) + 1];
  for (; column < 0; column += columns) ray += period_;
  while (true) {
    const int ahead = first_above(&reach_[static_cast<std::size_t>(column)], ray);
    column += ahead;
    if (column < columns) {
      if (ahead == block) continue;
      const bool upstream = ray < reach_[static_cast<std::size_t>(column)] - over_top_;
      if (upstream || !steps_.rises(column)) return {column, ray, upstream};
      ++column;
    }
    if (column >= columns) {
      ray -= period_;
      column = 0;
    }
  }
}

/// The summit that leaves, or `none`.
AEOLIAN_INLINE int LatticeSlice::ejected(const Contact& contact) {
  const bool brink = parameters_.brink_share > 0 && random_.uniform() < parameters_.brink_share;
  if (!brink) return steps_.summit(contact.column);
  return contact.upstream ? steps_.brink_from(contact.column, parameters_.brink_range)
                          : steps_.brink_up_to(contact.column, parameters_.brink_range);
}

AEOLIAN_INLINE void LatticeSlice::take(int summit) {
  steps_.turn(summit);
  reach_[static_cast<std::size_t>(summit)] -= 2 * unit_;
}

AEOLIAN_INLINE void LatticeSlice::put(int pocket) {
  steps_.turn(pocket);
  reach_[static_cast<std::size_t>(pocket)] += 2 * unit_;
  advance_starts(pocket);
}

/// Draws the intercepts of the next points.
AEOLIAN_KERNEL void LatticeSlice::draw_points() {
  constexpr std::size_t blocks = batch / 4;
  const auto period = static_cast<std::uint64_t>(period_);
  for (std::size_t i = 0; i < blocks; ++i) {
    const Philox::Block words = philox_(drawn_ + i, stream_);
    for (std::size_t k = 0; k < 4; ++k) points_[k * blocks + i] = static_cast<int>(words[k] * period >> 32);
  }
  drawn_ += blocks;
  next_ = 0;
}

/// Whether a grain gone from a summit to a pocket may have changed a contact found before.
AEOLIAN_INLINE bool LatticeSlice::disturbed(const Contact& contact, int summit, int pocket) const {
  const int around = -static_cast<int>(pocket >= contact.column) & period_;  // without a branch
  const int shadow = reach_[static_cast<std::size_t>(pocket)] - around;
  return (contact.column == summit) | !contact.upstream | (shadow > contact.ray);
}

/// The contact of the next grain is sought while this one is on its way: neither waits for the other. It is
/// sought again where the bed has changed under it.
AEOLIAN_KERNEL void LatticeSlice::shoot_from(const int* point, const int* end) {
  const int forward = parameters_.forward % parameters_.columns;
  const int backward = parameters_.backward % parameters_.columns;
  const int hits = parameters_.hits_per_point;
  int hit = 0;
  Contact next = first_contact(*point);
  while (point != end) {
    const Contact contact = next;
    if (++hit == hits) {
      hit = 0;
      ++point;
    }
    const int ray = *point;
    next = first_contact(ray);
    counts_.backward += static_cast<int>(!contact.upstream);
    const int summit = ejected(contact);
    if (summit == StepRing::none) {
      ++counts_.refused;
      continue;
    }
    take(summit);
    const int pocket = contact.upstream ? steps_.pocket_from(steps_.inside(summit + forward))
                                        : steps_.pocket_up_to(steps_.inside(summit - backward));
    put(pocket);
    if (disturbed(next, summit, pocket)) next = first_contact(ray);
  }
}

void LatticeSlice::shoot(std::int64_t points) {
  require(points >= 0, "number of points", static_cast<double>(points), "zero or more");
  while (points > 0) {
    if (next_ == batch) draw_points();
    if (since_starts_ >= starts_hold * parameters_.columns) find_starts();
    const auto count =
        static_cast<std::size_t>(std::min<std::int64_t>(points, static_cast<std::int64_t>(batch - next_)));
    shoot_from(&points_[next_], &points_[next_] + count);
    next_ += count;
    points -= static_cast<std::int64_t>(count);
    since_starts_ += static_cast<int>(count);
    counts_.impacts += static_cast<std::int64_t>(count) * parameters_.hits_per_point;
  }
}

}  // namespace aeolian
