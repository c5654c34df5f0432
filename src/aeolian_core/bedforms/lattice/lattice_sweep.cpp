/// How wind moves a LatticeBed: impacts along wind-aligned paths, the free grain that each sets going, and
/// where it rests.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "aeolian_core/bedforms/lattice/lattice_column.hpp"

namespace aeolian {
namespace {

/// No more than this share of the columns is struck in one sweep, so that every impact sees the bed as it is.
constexpr double struck_per_sweep = 0.05;

/// Standard deviation of a hop across the wind / mean length of hops.
constexpr double lateral_spread = 0.25;

/// Tangent of the angle at which reptating grains come down. Ejecta rise at about 0.5 m/s and travel 4 cm
/// (splash specification, sec. 2.4: coarse sand), sped up by the wind all the way: they land at 0.45 m/s
/// down, 0.6 m/s along. So on a slope they fly less far upwards and farther down, by slope / landing_slope of
/// their way.
constexpr double landing_slope = 0.75;

/// Columns of a path are looked at this many at a time.
constexpr int block = 16;

using EightShort = std::int16_t __attribute__((vector_size(16)));
using Eight = std::int32_t __attribute__((vector_size(32)));

/// Where heights stand as seen along the falling grains: `per_layer` for each layer and `step` for each
/// column downwind.
struct Envelope {
  int low;  ///< a height, from which all are counted
  int per_layer;
  int step;

  int at(int height, int column) const { return (height - low) * per_layer + column * step; }

  /// Which of a block of columns, from `column` on, stand at `level` or above: a bit for each.
  AEOLIAN_INLINE unsigned above(const std::int16_t* heights, int column, int level) const {
    EightShort first, second;
    std::memcpy(&first, heights, sizeof first);
    std::memcpy(&second, heights + 8, sizeof second);
    const Eight least = level - at(0, column) - Eight{0, 1, 2, 3, 4, 5, 6, 7} * step;
    const Eight bits = ((__builtin_convertvector(first, Eight) * per_layer >= least) &
                        Eight{1, 1 << 1, 1 << 2, 1 << 3, 1 << 4, 1 << 5, 1 << 6, 1 << 7}) |
                       ((__builtin_convertvector(second, Eight) * per_layer >= least - 8 * step) &
                        Eight{1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15});
    std::uint64_t pairs[4];
    std::memcpy(pairs, &bits, sizeof pairs);
    const std::uint64_t all = pairs[0] | pairs[1] | pairs[2] | pairs[3];
    return static_cast<unsigned>(all | all >> 32);
  }
};

}  // namespace

/// The lattice line that follows the wind: one step along the axis nearest to the wind each time, and a step
/// across whenever the line has drifted by a column. All lines of a sweep are alike, so that each column lies
/// on exactly one.
struct LatticeBed::Path {
  bool along_x;
  bool forward;  ///< towards growing x or y
  int count;     ///< columns of a line in one period
  int lines;
  double step;                       ///< length of wind between two columns of a line, in spacings
  std::vector<int> drift;            ///< across, in [0, lines), of the columns from minus one period to one
  std::uint32_t across_stride;       ///< between columns of lines beside each other, in the order of storage
  std::uint32_t along_stride;        ///< and from column to column of a line; modulo 2^32 where that is back
  std::vector<std::uint32_t> along;  ///< where each column would be without drift, in that order
  std::vector<int> level_to;         ///< of each column: before this one the drift stays the same

  Column column(int line, int i) const {
    const int in_drift = i + count;
    int across = line + drift[static_cast<std::size_t>(in_drift)];
    if (across >= lines) across -= lines;
    const int on = i < 0 ? i + count : i;
    const int place = forward ? on : count - 1 - on;
    return along_x ? Column{place, across} : Column{across, place};
  }
};

struct LatticeBed::Hop {
  float along_x, along_y;    ///< mean hop [columns]
  float across_x, across_y;  ///< standard deviation across the wind [columns]
  float fall;                ///< of a hop of mean length over its own length at the landing angle [layers]
};

AEOLIAN_INLINE void LatticeBed::eject(Column struck, const EjectionDraws::Draw& draw, const Hop& hop) {
  std::uint32_t ways = draw.ways;
  const Column from = walk<true>(struck, ways);
  const int middle = height_[index(from)] - 1;
  change<-2>(from);

  const float hop_x = draw.length * hop.along_x + draw.across * hop.across_x;
  const float hop_y = draw.length * hop.along_y + draw.across * hop.across_y;
  const auto wrapped = [](float position, int n) {
    auto i = static_cast<int>(std::floor(position + 0.5F));
    if (static_cast<unsigned>(i) >= static_cast<unsigned>(n)) i = (i % n + n) % n;
    return i;
  };
  const auto landing = [&](float share) {
    return Column{wrapped(static_cast<float>(from.x) + share * hop_x, nx_),
                  wrapped(static_cast<float>(from.y) + share * hop_y, ny_)};
  };
  const auto rise = static_cast<float>(height_[index(landing(1))] - middle);
  const float share = std::clamp(1 - rise / (draw.length * hop.fall), 0.0F, 2.0F);
  change<2>(walk<false>(landing(share), ways));
  ++ejections_;
}

LatticeBed::Path LatticeBed::wind_path(double direction) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  Path path;
  path.along_x = std::abs(c) >= std::abs(s);
  const double along = path.along_x ? c : s;
  const double across = path.along_x ? s : c;
  path.forward = along > 0;
  path.count = path.along_x ? nx_ : ny_;
  path.lines = path.along_x ? ny_ : nx_;
  path.step = 1 / std::abs(along);
  const auto nx = static_cast<std::uint32_t>(nx_);
  path.across_stride = path.along_x ? nx : 1;
  path.along_stride = (path.along_x ? 1 : nx) * (path.forward ? 1U : ~0U);
  // A new phase each sweep, so that no column is always the one at which lines step across.
  const double phase = random_.uniform();
  for (int i = -path.count; i < path.count; ++i) {
    const int drift = static_cast<int>(std::floor(i * across * path.step + phase)) % path.lines;
    path.drift.push_back(drift < 0 ? drift + path.lines : drift);
    const int on = i < 0 ? i + path.count : i;
    path.along.push_back(static_cast<std::uint32_t>(path.forward ? on : path.count - 1 - on) *
                         (path.along_x ? 1 : nx));
  }
  path.level_to.assign(path.drift.size(), path.count);
  for (std::size_t i = path.drift.size() - 1; i-- > 0;)
    path.level_to[i] =
        path.drift[i] == path.drift[i + 1] ? path.level_to[i + 1] : static_cast<int>(i) + 1 - path.count;
  return path;
}

/// A block of columns of a line, from one on; those beyond its end are lower than any.
struct LatticeBed::Block {
  const std::int16_t* heights;
  std::array<std::uint32_t, block> index;  ///< of the columns, unless their heights are looked at in place
  std::array<std::int16_t, block> copy;
  int columns;

  AEOLIAN_INLINE Block(const LatticeBed& bed, const Path& path, int line, int from)
      : columns(std::min(block, path.count - from)) {
    const int in_path = from + path.count;
    const auto at = static_cast<std::size_t>(in_path);
    const auto begin = static_cast<std::uint32_t>(bed.index(path.column(line, from)));
    if (from + block <= path.level_to[at] && (from >= 0 || from + block <= 0)) {
      if (path.along_stride == 1) {
        heights = &bed.height_[begin];
        return;
      }
      for (std::uint32_t k = 0; k < block; ++k) index[k] = begin + k * path.along_stride;
    } else {
      for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) {
        const int across = path.drift[at + k] + line;
        index[k] = path.along[at + k] +
                   path.across_stride *
                       static_cast<std::uint32_t>(across >= path.lines ? across - path.lines : across);
      }
    }
    copy.fill(std::numeric_limits<std::int16_t>::min());
    heights = copy.data();
    refresh(bed, 0);
  }
  /// From one on, after the bed has changed.
  AEOLIAN_INLINE void refresh(const LatticeBed& bed, int first) {
    if (heights != copy.data()) return;
    for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(columns); ++k)
      copy[k] = bed.height_[index[k]];
  }
};

/// One impact falls, on average, each time that the envelope of the bed seen along the falling grains rises
/// by `gap` drops, where `drop` is how far, in layers, a grain falls from one column of the path to the next.
/// Envelopes are reckoned in whole 1/1024 of a drop.
AEOLIAN_KERNEL void LatticeBed::sweep(const Path& path, double drop, double gap, const Hop& hop) {
  std::int16_t low = height_.front();
  std::int16_t high = low;
  for (const std::int16_t h : height_) {
    low = std::min(low, h);
    high = std::max(high, h);
  }
  int unit = 1024;
  while (unit > 1 && ((high - low) / drop + 2 * path.count) * unit > 1e9) unit /= 2;
  const Envelope envelope{low, static_cast<int>(std::lround(unit / drop)), unit};
  const int shadow = std::min(path.count, static_cast<int>(std::ceil((high - low) / drop)));
  const auto mean_gap = static_cast<float>(unit * gap);
  // A billion is beyond the end of every line.
  const auto gap_after = [&](float drawn) { return static_cast<int>(std::min(mean_gap * drawn, 1e9F)); };

  for (int line = 0; line < path.lines; ++line) {
    int next = std::numeric_limits<int>::min();
    for (int i = -shadow; i < 0; i += block) {
      const Block columns(*this, path, line, i);
      for (int k = 0; k < std::min(block, -i); ++k)
        next = std::max(next, envelope.at(columns.heights[k], i + k));
    }
    next += gap_after(draws_.next().gap);
    for (int i = 0; i < path.count; i += block) {
      Block columns(*this, path, line, i);
      unsigned ahead = ~0U;  // of the grains that fall: columns not passed yet
      while (const unsigned struck = envelope.above(columns.heights, i, next) & ahead) {
        const int k = __builtin_ctz(struck);
        ahead = ~0U << k;
        const EjectionDraws::Draw draw = draws_.next();
        eject(path.column(line, i + k), draw, hop);
        next += gap_after(draw.gap);
        columns.refresh(*this, k);
      }
    }
  }
}

void LatticeBed::advance(const Forcing& forcing, double duration) {
  check(forcing, duration);
  const double per_column = forcing.erosion_rate() * duration * spacing_ * spacing_ / grain_volume();
  if (per_column == 0) return;

  const double length = forcing.reptation_length / spacing_;
  const double spread = lateral_spread * length;
  const double c = std::cos(forcing.direction);
  const double s = std::sin(forcing.direction);
  const Hop hop{static_cast<float>(length * c), static_cast<float>(length * s),
                static_cast<float>(-spread * s), static_cast<float>(spread * c),
                static_cast<float>(forcing.reptation_length * landing_slope / layer_)};

  const double sweeps = std::ceil(per_column / struck_per_sweep);
  for (double n = 0; n < sweeps; ++n) {
    const Path path = wind_path(forcing.direction);
    sweep(path, path.step * spacing_ * std::tan(forcing.impact_angle) / layer_, sweeps / per_column, hop);
  }
}

}  // namespace aeolian
