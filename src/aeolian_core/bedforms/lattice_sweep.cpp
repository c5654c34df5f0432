/// How a LatticeBed moves: impacts along wind-aligned paths, the free grain that each sets going, and where
/// it rests.

#include <algorithm>
#include <array>
#include <cmath>

#include "aeolian_core/bedforms/lattice_bed.hpp"

namespace aeolian {
namespace {

/// Of a set of neighbours (bit 0 east, 1 west, 2 north, 3 south), the n-th member.
struct Choice {
  std::array<std::array<std::uint8_t, 4>, 16> member{};
  std::array<std::uint8_t, 16> count{};

  Choice() {
    for (unsigned set = 1; set < 16; ++set)
      for (unsigned n = 0; n < 4; ++n)
        if (set >> n & 1U) member[set][count[set]++] = static_cast<std::uint8_t>(n);
  }
};

const Choice choice;

/// No more than this share of the columns is struck in one sweep, so that every impact sees the bed as it is.
constexpr double struck_per_sweep = 0.05;

/// Standard deviation of a hop across the wind / mean length of hops.
constexpr double lateral_spread = 0.25;

}  // namespace

/// The lattice line that follows the wind: one step along the axis nearest to the wind each time, and a step
/// across whenever the line has drifted by a column. All lines of a sweep are alike, so that each column lies
/// on exactly one.
struct LatticeBed::Path {
  int count;               ///< columns of the line in one period
  int lines;               ///< columns across
  int stride;              ///< from line to line
  double step;             ///< length of wind between two columns of the line, in spacings
  std::vector<int> base;   ///< index of each column of the line, were it on line 0
  std::vector<int> drift;  ///< line on which each column is, of the line that starts on 0: one period upwind,
                           ///< then one more
};

struct LatticeBed::Hop {
  double along_x, along_y;    ///< mean hop [columns]
  double across_x, across_y;  ///< standard deviation across the wind [columns]
};

template <bool up>
int LatticeBed::walk(int at) {
  const int columns = nx_ * ny_;
  std::uint32_t bits = 0;
  for (int steps = 0;; ++steps) {
    const int x = at % nx_;
    const std::array<int, 4> neighbour{x + 1 == nx_ ? at + 1 - nx_ : at + 1, x == 0 ? at - 1 + nx_ : at - 1,
                                       at + nx_ >= columns ? at + nx_ - columns : at + nx_,
                                       at < nx_ ? at - nx_ + columns : at - nx_};
    const int here = height_[static_cast<std::size_t>(at)];
    unsigned set = 0;
    for (unsigned n = 0; n < 4; ++n) {
      const int there = height_[static_cast<std::size_t>(neighbour[n])];
      set |= static_cast<unsigned>(up ? there > here : there < here) << n;
    }
    if (set == 0) return at;
    if (steps % 4 == 0) bits = random_.bits();
    at = neighbour[choice.member[set][(bits & 0xFFU) * choice.count[set] >> 8]];
    bits >>= 8;
  }
}

int LatticeBed::climb(int at) { return walk<true>(at); }

int LatticeBed::descend(int at) { return walk<false>(at); }

void LatticeBed::eject(int struck, const Hop& hop) {
  const int from = climb(struck);
  const double length = random_.exponential();
  const double across = random_.normal();
  const auto wrap = [](double position, int n) {
    return static_cast<int>(position - std::floor(position / n) * n) % n;
  };
  const int x = wrap(from % nx_ + 0.5 + length * hop.along_x + across * hop.across_x, nx_);
  const int y = wrap(from / nx_ + 0.5 + length * hop.along_y + across * hop.across_y, ny_);
  height_[static_cast<std::size_t>(from)] -= 2;
  height_[static_cast<std::size_t>(descend(y * nx_ + x))] += 2;
  ++ejections_;
}

LatticeBed::Path LatticeBed::wind_path(double direction) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const bool along_x = std::abs(c) >= std::abs(s);
  const double along = along_x ? c : s;
  const double across = along_x ? s : c;
  Path path;
  path.count = along_x ? nx_ : ny_;
  path.lines = along_x ? ny_ : nx_;
  path.stride = along_x ? nx_ : 1;
  path.step = 1 / std::abs(along);
  for (int i = 0; i < path.count; ++i)
    path.base.push_back((along > 0 ? i : path.count - 1 - i) * (along_x ? 1 : nx_));
  // A new phase each sweep, so that no column is always the one at which lines step across.
  const double phase = random_.uniform();
  for (int i = -path.count; i < path.count; ++i) {
    const int drift = static_cast<int>(std::floor(i * across * path.step + phase)) % path.lines;
    path.drift.push_back(drift < 0 ? drift + path.lines : drift);
  }
  return path;
}

/// One impact falls, on average, each time that the envelope of the bed seen along the falling grains rises
/// by `gap` drops, where `drop` is how far, in layers, a grain falls from one column of the path to the next.
void LatticeBed::sweep(const Path& path, double drop, double gap, const Hop& hop) {
  const auto [low, high] = std::minmax_element(height_.begin(), height_.end());
  const int longest_shadow = static_cast<int>(std::ceil((*high - *low) / drop));
  const int reach = std::min(path.count, longest_shadow);
  const double per_drop = 1 / drop;
  const int* const drift = path.drift.data() + path.count;

  for (int line = 0; line < path.lines; ++line) {
    const auto column = [&](int base, int step_across) {
      int on = line + step_across;
      if (on >= path.lines) on -= path.lines;
      return base + on * path.stride;
    };
    const auto ray = [&](int i, int at) { return height_[static_cast<std::size_t>(at)] * per_drop + i; };

    double envelope = -1e300;
    for (int i = -reach; i < 0; ++i)
      envelope =
          std::max(envelope, ray(i, column(path.base[static_cast<std::size_t>(i + path.count)], drift[i])));
    double next = envelope + gap * random_.exponential();
    for (int i = 0; i < path.count; ++i) {
      const int at = column(path.base[static_cast<std::size_t>(i)], drift[i]);
      while (ray(i, at) >= next) {
        eject(at, hop);
        next += gap * random_.exponential();
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
  const Hop hop{length * c, length * s, -spread * s, spread * c};

  const double sweeps = std::ceil(per_column / struck_per_sweep);
  for (double n = 0; n < sweeps; ++n) {
    const Path path = wind_path(forcing.direction);
    sweep(path, path.step * spacing_ * std::tan(forcing.impact_angle) / layer_, sweeps / per_column, hop);
  }
}

}  // namespace aeolian
