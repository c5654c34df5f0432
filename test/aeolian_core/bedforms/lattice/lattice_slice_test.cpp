#include "aeolian_core/bedforms/lattice/lattice_slice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

SliceParameters small(int reptation = 8) {
  SliceParameters parameters;
  parameters.columns = 64;
  parameters.forward = parameters.backward = reptation;
  return parameters;
}

bool is_single_step(const std::vector<int>& heights) {
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (std::abs(heights[i] - heights[(i + 1) % heights.size()]) != 1) return false;
  return true;
}

std::vector<int> rough(const SliceParameters& parameters) {
  LatticeSlice bed(parameters, 9);
  bed.shoot(10 * parameters.columns);
  return bed.heights();
}

double deviation(const std::vector<int>& heights) {
  double mean = 0, square = 0;
  for (const int h : heights) mean += static_cast<double>(h) / static_cast<double>(heights.size());
  for (const int h : heights) square += (h - mean) * (h - mean);
  return std::sqrt(square / static_cast<double>(heights.size()));
}

/// Which grain a disk that falls along a line touches first, and on which side, by geometry alone: lengths in
/// grain diameters.
struct Touch {
  int column = -1;
  bool upstream = false;
};

Touch first_touch(const std::vector<int>& heights, double angle, double intercept) {
  const int n = static_cast<int>(heights.size());
  const double along_x = std::cos(angle), along_z = -std::sin(angle);
  Touch touch;
  double nearest = INFINITY;
  const int highest = *std::max_element(heights.begin(), heights.end());
  const int lowest = *std::min_element(heights.begin(), heights.end());
  const int shadow = static_cast<int>((highest - lowest + 4) / (std::sqrt(3.0) * std::tan(angle))) + 3;
  for (int i = -shadow; i < 2 * n; ++i) {
    const double x = std::sqrt(3.0) / 2 * i;
    const double z = 0.5 * heights[static_cast<std::size_t>(((i % n) + n) % n)];
    // Of the line through (0, intercept): where it is nearest to the centre, and how near.
    const double to = x * along_x + (z - intercept) * along_z;
    const double off = x * along_z - (z - intercept) * along_x;
    if (std::abs(off) > 1) continue;
    const double at = to - std::sqrt(1 - off * off);
    if (at < nearest) {
      nearest = at;
      touch = {((i % n) + n) % n, at * along_x < x};
    }
  }
  return touch;
}

int summit_above(const std::vector<int>& h, int at) {
  const int n = static_cast<int>(h.size());
  const auto height = [&](int i) { return h[static_cast<std::size_t>((i + n) % n)]; };
  while (height(at + 1) > height(at)) at = (at + 1) % n;
  while (height(at - 1) > height(at)) at = (at + n - 1) % n;
  return at;
}

int pocket_beyond(const std::vector<int>& h, int at, int way) {
  const int n = static_cast<int>(h.size());
  const auto height = [&](int i) { return h[static_cast<std::size_t>((i % n + n) % n)]; };
  while (height(at + 1) < height(at) || height(at - 1) < height(at)) at += way;
  return (at % n + n) % n;
}

/// The bed after one impact.
std::vector<int> after(std::vector<int> heights, Touch touch, const SliceParameters& parameters) {
  const int summit = summit_above(heights, touch.column);
  heights[static_cast<std::size_t>(summit)] -= 2;
  const int landing = summit + (touch.upstream ? parameters.forward : -parameters.backward);
  heights[static_cast<std::size_t>(pocket_beyond(heights, landing, touch.upstream ? 1 : -1))] += 2;
  return heights;
}

TEST(LatticeSliceTest, what_moves_is_what_a_falling_disk_touches_first) {
  for (const double angle : {0.02, 10 * degree, 35 * degree, 59 * degree, 65 * degree, 1.4}) {
    SliceParameters parameters = small();
    parameters.forward = 7;
    parameters.backward = 5;
    const std::vector<int> heights = rough(parameters);
    parameters.impact_angle = angle;
    std::map<std::vector<int>, double> expected;
    constexpr int rays = 20000;
    // Lines through one period of the bed; the first column's highest is no bound for lines from upwind.
    const double period = parameters.columns * std::sqrt(3.0) / 2 * std::tan(angle);
    for (int i = 0; i < rays; ++i)
      expected[after(heights, first_touch(heights, angle, (i + 0.5) / rays * period), parameters)] +=
          1.0 / rays;
    std::map<std::vector<int>, double> found;
    constexpr int shots = 20000;
    for (int i = 0; i < shots; ++i) {
      LatticeSlice bed(parameters, heights, 1, static_cast<std::uint64_t>(i));
      bed.shoot(1);
      found[bed.heights()] += 1.0 / shots;
    }
    for (const auto& [bed, share] : found) EXPECT_GT(expected.count(bed) > 0 ? 1.0 : 1e-3, share) << angle;
    for (const auto& [bed, share] : expected)
      EXPECT_NEAR(found[bed], share, 5 * std::sqrt(share / shots) + 2e-4) << angle;
  }
}

TEST(LatticeSliceTest, one_in_twenty_grains_is_struck_backwards_on_a_flat_bed) {
  // Of a summit, the downstream side is seen as 1 - cos of a diameter, the period as sqrt(3) sin.
  const double expected = (1 - std::cos(10 * degree)) / (std::sqrt(3.0) * std::sin(10 * degree));
  EXPECT_NEAR(expected, 0.05, 0.001);
  SliceParameters parameters;
  parameters.brink_share = 1;  // leaves a flat bed flat
  LatticeSlice bed(parameters, 1);
  bed.shoot(200000);
  EXPECT_NEAR(static_cast<double>(bed.counts().backward) / 200000, expected,
              4 * std::sqrt(expected / 200000));
}

TEST(LatticeSliceTest, keeps_its_grains_and_its_rule) {
  SliceParameters brinks = small(3);
  brinks.brink_share = 0.4;
  brinks.hits_per_point = 3;
  SliceParameters far = small(1000);
  SliceParameters shallow = small(), steep = small(1);
  shallow.impact_angle = 0.02;
  steep.impact_angle = 1.4;
  for (const SliceParameters& parameters : {small(), brinks, far, shallow, steep}) {
    LatticeSlice bed(parameters, 2);
    for (int i = 0; i < 10; ++i) {
      bed.shoot(20000);
      const std::vector<int> heights = bed.heights();
      EXPECT_EQ(std::accumulate(heights.begin(), heights.end(), 0), parameters.columns / 2);
      EXPECT_TRUE(is_single_step(heights));
    }
    const SliceCounts& counts = bed.counts();
    EXPECT_EQ(counts.impacts, 200000 * parameters.hits_per_point);
    EXPECT_EQ(counts.refused > 0, parameters.brink_share > 0);
    EXPECT_EQ(bed.ejections_per_surface_grain(), static_cast<double>(counts.ejections()) / 32);
    EXPECT_NEAR(bed.elevation()[5], bed.heights()[5] * std::tan(30 * degree), 1e-12);
  }
}

TEST(LatticeSliceTest, brink_ejection_leaves_a_flat_bed_flat_and_smooths_a_rough_one) {
  SliceParameters parameters;
  parameters.columns = 1024;
  const std::vector<int> heights = rough(parameters);
  parameters.brink_share = 1;
  LatticeSlice flat(parameters, 3), bed(parameters, heights, 3);
  const std::vector<int> before = flat.heights();
  flat.shoot(100000);
  EXPECT_EQ(flat.counts().ejections(), 0);
  EXPECT_EQ(flat.heights(), before);
  bed.shoot(20 * parameters.columns);
  EXPECT_LT(deviation(bed.heights()), 0.7 * deviation(heights));
}

TEST(LatticeSliceTest, both_ends_of_the_bed_are_joined) {
  // A hop of the bed's length more is the same hop.
  SliceParameters parameters = small(), once_around = small();
  once_around.forward += 64;
  once_around.backward += 128;
  LatticeSlice bed(parameters, 4), other(once_around, 4);
  bed.shoot(5000);
  other.shoot(5000);
  EXPECT_EQ(bed.heights(), other.heights());
}

TEST(LatticeSliceTest, each_impact_sees_the_bed_as_the_last_one_left_it) {
  // Shot one at a time, no contact is sought ahead.
  for (const double angle : {0.02, 10 * degree, 70 * degree})
    for (const int hits : {1, 3}) {
      SliceParameters parameters = small(5);
      parameters.impact_angle = angle;
      parameters.hits_per_point = hits;
      parameters.brink_share = hits == 1 ? 0 : 0.3;
      LatticeSlice at_once(parameters, 6), singly(parameters, 6);
      at_once.shoot(20000);
      for (int i = 0; i < 20000; ++i) singly.shoot(1);
      EXPECT_EQ(at_once.heights(), singly.heights()) << angle;
    }
}

TEST(LatticeSliceTest, a_run_depends_on_its_seed_and_stream_only) {
  const SliceParameters parameters = small();
  LatticeSlice at_once(parameters, 5), in_parts(parameters, 5), other(parameters, 6),
      stream(parameters, 5, 1);
  at_once.shoot(3001);
  for (const int part : {1, 1000, 0, 2000}) in_parts.shoot(part);
  other.shoot(3001);
  stream.shoot(3001);
  EXPECT_EQ(at_once.heights(), in_parts.heights());
  EXPECT_NE(at_once.heights(), other.heights());
  EXPECT_NE(at_once.heights(), stream.heights());
}

TEST(LatticeSliceTest, ripples_grow_under_target_ejection) {
  SliceParameters parameters;
  LatticeSlice bed(parameters, 7);
  bed.shoot(5 * parameters.columns);
  const double young = deviation(bed.heights());
  bed.shoot(15 * parameters.columns);
  EXPECT_GT(deviation(bed.heights()), 1.5 * young);
}

TEST(LatticeSliceTest, refuses_what_is_no_bed) {
  const auto error = [](auto change) {
    SliceParameters parameters;
    change(parameters);
    return error_of([&] { LatticeSlice(parameters, 1); });
  };
  EXPECT_EQ(error([](auto& p) { p.columns = 100; }),
            "lattice slice: number of columns is 100, must be a multiple of 64, at most a million");
  EXPECT_EQ(error([](auto& p) { p.columns = -64; }),
            "lattice slice: number of columns is -64, must be a multiple of 64, at most a million");
  EXPECT_EQ(error([](auto& p) { p.impact_angle = 10; }),
            "lattice slice: impact angle [rad] is 10, must be from 0.02 to 1.4");
  EXPECT_EQ(error([](auto& p) { p.forward = 0; }),
            "lattice slice: forward reptation length is 0, must be 1 or more half-spacings");
  EXPECT_EQ(error([](auto& p) { p.backward = -1; }),
            "lattice slice: backward reptation length is -1, must be 1 or more half-spacings");
  EXPECT_EQ(error([](auto& p) { p.brink_share = NAN; }),
            "lattice slice: share of brink ejections is nan, must be from 0 to 1");
  EXPECT_EQ(error([](auto& p) { p.brink_range = -1; }),
            "lattice slice: range of the search for a brink is -1, must be 0 or more half-spacings");
  EXPECT_EQ(error([](auto& p) { p.hits_per_point = 0; }),
            "lattice slice: number of hits per point is 0, must be 1 or more");
  EXPECT_EQ(error_of([] { LatticeSlice({}, 1).shoot(-1); }),
            "lattice slice: number of points is -1, must be zero or more");
  EXPECT_EQ(error_of([] { LatticeSlice(small(), {0, 1}, 1); }), "lattice slice: 2 heights for 64 columns");
  std::vector<int> torn(64);
  for (std::size_t i = 1; i < torn.size(); i += 2) torn[i] = 1;
  torn[10] = 2;
  torn[11] = 5;
  EXPECT_EQ(error_of([&] { LatticeSlice(small(), torn, 1); }),
            "lattice slice: column 10 is 2 layers high, the next 5; they must be one apart, and even columns "
            "even");
}

}  // namespace
}  // namespace aeolian
