#include "aeolian_core/bedforms/theory/worm_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(WormModelTest, two_worms_of_five_links_merge_as_often_as_specified) {
  struct Case {
    double pace, probability;
  };
  for (const Case& c : {Case{0.3, 0.102}, Case{0.5, 0.064}, Case{0.7, 0.033}, Case{0.8, 0.020},
                        Case{0.9, 0.0092}, Case{0.95, 0.0043}})
    EXPECT_NEAR(merger_probability(5, 5, c.pace, std::llround(250 / c.pace)), c.probability, 0.0005)
        << c.pace;
  EXPECT_EQ(merger_probability(5, 5, 1, 100000), 0);
}

TEST(WormModelTest, the_chain_has_the_probabilities_of_one_step) {
  // The lone link is lost when it rests (1 - 0.5) while the other, of three, moves (0.5 / 3).
  EXPECT_NEAR(merger_probability(1, 3, 0.5, 1), 0.5 * 0.5 / 3, 1e-15);
  EXPECT_EQ(merger_probability(2, 2, 0.5, 1), 0);
  EXPECT_EQ(merger_probability(5, 5, 0.5, 0), 0);
  EXPECT_NEAR(merger_probability(5, 5, 0.5, 1000000), 1, 1e-9);
}

TEST(WormModelTest, play_agrees_with_the_chain) {
  constexpr int members = 10000;
  const double exact = merger_probability(5, 5, 0.5, 500);
  const double played = static_cast<double>(count_mergers(5, 5, 0.5, 500, members, 1)) / members;
  EXPECT_NEAR(played, exact, 2 * std::sqrt(exact * (1 - exact) / members));
  EXPECT_EQ(count_mergers(5, 5, 1, 500, 100, 1), 0);
}

TEST(WormModelTest, worms_on_a_ring_grow_with_the_logarithm_of_time) {
  const std::vector<WormGrowth> growth =
      grow_worms(WormRing(2000, 2, 0.5, 1), {10, 100, 1000, 3000, 10000, 30000, 100000, 300000});
  // Specification sec. 4.
  EXPECT_NEAR(growth[0].mean_length, 2.42, 0.06);
  EXPECT_NEAR(growth[1].mean_length, 3.87, 0.12);
  EXPECT_NEAR(growth[0].deviation / growth[0].mean_length, 0.41, 0.02);
  const double slope = logarithmic_slope({growth.begin() + 2, growth.end()});
  EXPECT_GT(slope, 0.9);
  EXPECT_LT(slope, 1.1);
}

TEST(WormModelTest, links_are_conserved_and_full_pace_never_merges) {
  WormRing ring(100, 3, 0.7, 5);
  ring.advance(20000);
  const std::vector<int> lengths = ring.lengths();
  EXPECT_EQ(std::accumulate(lengths.begin(), lengths.end(), 0), 300);
  EXPECT_LT(lengths.size(), 100U);
  EXPECT_EQ(std::count(lengths.begin(), lengths.end(), 0), 0);
  WormRing brisk(100, 3, 1, 5);
  brisk.advance(20000);
  EXPECT_EQ(brisk.lengths().size(), 100U);
  WormRing last(2, 1, 0.5, 5);
  last.advance(1000);
  EXPECT_EQ(last.lengths(), std::vector<int>{2});
}

TEST(WormModelTest, a_run_depends_on_its_seed_and_its_stream_only) {
  const auto lengths = [](std::uint64_t seed, std::uint64_t stream, std::int64_t first) {
    WormRing ring(50, 4, 0.5, seed, stream);
    ring.advance(first);
    ring.advance(500 - first);
    return ring.lengths();
  };
  EXPECT_EQ(lengths(1, 0, 500), lengths(1, 0, 123));
  EXPECT_NE(lengths(1, 0, 500), lengths(2, 0, 500));
  EXPECT_NE(lengths(1, 0, 500), lengths(1, 1, 500));
}

TEST(WormModelTest, fluctuations_are_those_of_the_thesis_own_formula) {
  EXPECT_NEAR(worm_fluctuation(10, 1), 0.30, 1e-12);
  EXPECT_NEAR(worm_fluctuation(5, 1), 0.40, 1e-12);
  EXPECT_NEAR(worm_fluctuation(2, 1), 0.50, 1e-12);
}

TEST(WormModelTest, refuses_what_is_no_worm) {
  EXPECT_EQ(error_of([] { merger_probability(5, 5, 1.5, 10); }),
            "worms: pace is 1.500000, must be above 0 and not above 1");
  EXPECT_EQ(error_of([] { merger_probability(0, 5, 0.5, 10); }),
            "worms: lengths of a pair are 0 and 5, must be at least 1");
  EXPECT_EQ(error_of([] { merger_probability(5, 5, 0.5, -1); }), "worms: -1 steps, must not be negative");
  EXPECT_EQ(error_of([] { count_mergers(5, 5, 0.5, 10, 0, 1); }), "worms: 0 members, must be at least 1");
  EXPECT_EQ(error_of([] { WormRing(0, 2, 0.5, 1); }),
            "worms: 0 worms of 2 links, must be at least one of one and not above 10000000 links in all");
  EXPECT_NE(error_of([] { WormRing(1000000, 1000000, 0.5, 1); }), "no error was thrown");
  EXPECT_EQ(error_of([] {
              grow_worms(WormRing(2, 2, 0.5, 1), {10, 5});
            }),
            "worms: times must rise, 5 follows 10");
}

}  // namespace
}  // namespace aeolian
