/// How a LatticeBed moves: impacts along wind-aligned paths, the free grain that each sets going, and where
/// it rests.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "aeolian_core/bedforms/lattice_bed.hpp"

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

/// Exponential with mean 1, in single precision for speed.
float exponential(RandomStream& random) {
  return -std::log((static_cast<float>(random.bits() >> 8) + 0.5F) * 0x1p-24F);
}

/// Bell-shaped with standard deviation 1: the sum of four uniform numbers, the bytes of one word.
float bell(RandomStream& random) {
  const std::uint32_t word = random.bits();
  const std::uint32_t pairs = (word & 0x00FF00FFU) + (word >> 8 & 0x00FF00FFU);
  const auto sum = static_cast<int>((pairs & 0xFFFFU) + (pairs >> 16));
  constexpr float standard_deviation = 147.8F;  // sqrt(4 (256^2 - 1) / 12)
  return static_cast<float>(sum - 510) / standard_deviation;
}

/// Of a set of neighbours (bit 0 east, 1 west, 2 north, 3 south), the n-th member.
struct Choice {
  std::array<std::array<std::uint8_t, 4>, 16> member{};
  std::array<std::uint8_t, 16> count{};

  constexpr Choice() {
    for (unsigned set = 1; set < 16; ++set)
      for (std::uint8_t n = 0; n < 4; ++n)
        if ((set >> n & 1U) != 0) member[set][count[set]++] = n;
  }
};
constexpr Choice choice;

}  // namespace

struct LatticeBed::Column {
  int x, y;
};

/// The lattice line that follows the wind: one step along the axis nearest to the wind each time, and a step
/// across whenever the line has drifted by a column. All lines of a sweep are alike, so that each column lies
/// on exactly one. A line is told as runs of columns between two steps across.
struct LatticeBed::Path {
  struct Run {
    int begin, end;  ///< columns along the line; from minus one period to one
    int drift;       ///< across, in [0, lines)
  };
  bool along_x;
  bool forward;  ///< towards growing x or y
  int count;     ///< columns of a line in one period
  int lines;
  double step;  ///< length of wind between two columns of a line, in spacings
  std::vector<Run> runs;
  std::size_t first_run;  ///< of those that begin at 0
};

struct LatticeBed::Hop {
  float along_x, along_y;    ///< mean hop [columns]
  float across_x, across_y;  ///< standard deviation across the wind [columns]
  float fall;                ///< of a hop of mean length over its own length at the landing angle [layers]
};

inline std::int16_t& LatticeBed::height(Column at) {
  return height_[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(nx_) +
                 static_cast<std::size_t>(at.x)];
}

/// Up or down the slope, at random among the neighbours that are higher or lower, to where there are none.
template <bool up>
LatticeBed::Column LatticeBed::walk(Column at) {
  std::uint32_t bits = random_.bits();
  while (true) {
    const std::array<Column, 4> neighbour{{{at.x + 1 == nx_ ? 0 : at.x + 1, at.y},
                                           {at.x == 0 ? nx_ - 1 : at.x - 1, at.y},
                                           {at.x, at.y + 1 == ny_ ? 0 : at.y + 1},
                                           {at.x, at.y == 0 ? ny_ - 1 : at.y - 1}}};
    const int here = height(at);
    unsigned set = 0;
    for (unsigned n = 0; n < 4; ++n) {
      const int there = height(neighbour[n]);
      set |= static_cast<unsigned>(up ? there > here : there < here) << n;
    }
    if (set == 0) return at;
    at = neighbour[choice.member[set][(bits >> 24) * choice.count[set] >> 8]];
    bits = bits * 0x9E3779B1U + 0x7F4A7C15U;
  }
}

LatticeBed::Column LatticeBed::anywhere() {
  const int x = static_cast<int>(random_.uniform() * nx_);
  return {x, static_cast<int>(random_.uniform() * ny_)};
}

void LatticeBed::roughen(double moves_per_column) {
  for (auto moves = static_cast<std::int64_t>(moves_per_column * nx_ * ny_); moves > 0; --moves) {
    height(walk<true>(anywhere())) -= 2;
    height(walk<false>(anywhere())) += 2;
  }
}

/// Lays grains down, or takes some away, at random places.
void LatticeBed::settle(std::int64_t grains) {
  for (; grains > 0; --grains) height(walk<false>(anywhere())) += 2;
  for (; grains < 0; ++grains) height(walk<true>(anywhere())) -= 2;
}

void LatticeBed::eject(Column struck, const Hop& hop) {
  const Column from = walk<true>(struck);
  const int middle = height(from) - 1;
  height(from) -= 2;

  const float length = exponential(random_);
  const float across = bell(random_);
  const float hop_x = length * hop.along_x + across * hop.across_x;
  const float hop_y = length * hop.along_y + across * hop.across_y;
  const auto wrapped = [](float position, int n) {
    auto i = static_cast<int>(std::floor(position + 0.5F));
    if (static_cast<unsigned>(i) >= static_cast<unsigned>(n)) i = (i % n + n) % n;
    return i;
  };
  const auto landing = [&](float share) {
    return Column{wrapped(static_cast<float>(from.x) + share * hop_x, nx_),
                  wrapped(static_cast<float>(from.y) + share * hop_y, ny_)};
  };
  const auto rise = static_cast<float>(height(landing(1)) - middle);
  const float share = std::clamp(1 - rise / (length * hop.fall), 0.0F, 2.0F);
  height(walk<false>(landing(share))) += 2;
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
  // A new phase each sweep, so that no column is always the one at which lines step across.
  const double phase = random_.uniform();
  for (int i = -path.count; i < path.count; ++i) {
    int drift = static_cast<int>(std::floor(i * across * path.step + phase)) % path.lines;
    if (drift < 0) drift += path.lines;
    if (i == 0) path.first_run = path.runs.size();
    if (i == 0 || path.runs.empty() || path.runs.back().drift != drift) path.runs.push_back({i, i, drift});
    path.runs.back().end = i + 1;
  }
  return path;
}

/// One impact falls, on average, each time that the envelope of the bed seen along the falling grains rises
/// by `gap` drops, where `drop` is how far, in layers, a grain falls from one column of the path to the next.
/// Envelopes are reckoned in whole 1/1024 of a drop.
void LatticeBed::sweep(const Path& path, double drop, double gap, const Hop& hop) {
  std::int16_t low = height_.front();
  std::int16_t high = low;
  for (const std::int16_t h : height_) {
    low = std::min(low, h);
    high = std::max(high, h);
  }
  int unit = 1024;
  while (unit > 1 && ((high - low) / drop + 2 * path.count) * unit > 1e9) unit /= 2;
  const int longest_shadow = static_cast<int>(std::ceil((high - low) / drop));
  const auto per_layer = static_cast<int>(std::lround(unit / drop));
  const auto mean_gap = static_cast<float>(unit * gap);
  const int forward = path.forward ? 1 : -1;
  const int stride = forward * (path.along_x ? 1 : nx_);
  constexpr int block = 16;

  for (int line = 0; line < path.lines; ++line) {
    const auto column = [&](const Path::Run& run, int i) {
      int across = line + run.drift;
      if (across >= path.lines) across -= path.lines;
      const int on = i < 0 ? i + path.count : i;
      const int along = path.forward ? on : path.count - 1 - on;
      return path.along_x ? Column{along, across} : Column{across, along};
    };
    const auto ray = [&](std::int16_t h, int i) { return (h - low) * per_layer + i * unit; };
    const auto draw_gap = [&] { return static_cast<int>(mean_gap * exponential(random_)); };

    int next = std::numeric_limits<int>::min();
    for (std::size_t r = 0; r < path.first_run; ++r) {
      const Path::Run& run = path.runs[r];
      for (int i = std::max(run.begin, -longest_shadow); i < run.end; ++i)
        next = std::max(next, ray(height(column(run, i)), i));
    }
    next += draw_gap();
    for (std::size_t r = path.first_run; r < path.runs.size(); ++r) {
      const Path::Run& run = path.runs[r];
      for (int i = run.begin; i < run.end; i += block) {
        const int columns = std::min(block, run.end - i);
        const std::int16_t* const at = &height(column(run, i));
        if (columns == block && path.along_x) {
          // The common case, without a branch for each column: may any of the block be struck?
          const std::int16_t* const first = path.forward ? at : at - (block - 1);
          int top = std::numeric_limits<int>::min();
          for (int k = 0; k < block; ++k) top = std::max(top, ray(first[k], forward * k));
          if (top + (path.forward ? i : i + block - 1) * unit < next) continue;
        }
        for (int k = 0; k < columns; ++k)
          while (ray(at[k * stride], i + k) >= next) {
            eject(column(run, i + k), hop);
            next += draw_gap();
          }
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
