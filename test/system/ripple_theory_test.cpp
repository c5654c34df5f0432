// ripple_theory as people run it.
#include <cmath>
#include <numeric>

#include "program_outcome.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/csv.hpp"

namespace aeolian {
namespace {

/// The value of a column where another has a value.
double look_up(const Table& table, const std::string& key, double value, const std::string& column) {
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (std::abs(table.column(key)[i] - value) < 1e-9) return table.column(column)[i];
  return NAN;
}

TEST(RippleTheoryTest, writes_the_thesis_figures) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program("ripple_theory --out new/folder --seed 2", folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "collisions, limiting_wavelengths, worms, haff -> new/folder\n");
  const std::string out = folder.file("new/folder/");
  for (const char* name : {"collisions", "limiting_wavelengths", "worms", "haff"}) {
    const std::string picture = content_of(out + name + ".svg");
    EXPECT_NE(picture.find("<svg"), std::string::npos) << name;
    EXPECT_EQ(picture.substr(picture.size() - 8), "</svg>\n\n") << name;
  }

  const Table collisions = read_csv(out + "collisions.csv");
  EXPECT_NEAR(look_up(collisions, "ratio_before", 0.5, "target_downstream_after"), 0.5, 1e-9);
  EXPECT_NEAR(look_up(collisions, "ratio_before", 0.5, "brink_upstream_after"), 0.894, 0.002);
  const Table limits = read_csv(out + "limiting_wavelengths.csv");
  EXPECT_NEAR(look_up(limits, "ratio_before", 0.8, "overshoot_merged_m"), 0.214, 0.002);
  const Table growth = read_csv(out + "worm_growth.csv");
  EXPECT_NEAR(look_up(growth, "steps", 10, "mean_length"), 2.42, 0.05);
  const Table pairs = read_csv(out + "worm_pairs.csv");
  EXPECT_NEAR(look_up(pairs, "pace", 0.5, "chain"), 0.064, 0.0005);
  EXPECT_NEAR(look_up(pairs, "pace", 0.5, "play"), 0.064, 4 * look_up(pairs, "pace", 0.5, "standard_error"));
  const Table beds = read_csv(out + "haff_profiles.csv");
  EXPECT_EQ(beds.names, (std::vector<std::string>{"x_d", "free_30_d", "free_95_d", "free_300_d",
                                                  "limited_30_d", "limited_95_d", "limited_300_d"}));
  for (std::size_t i = 1; i < beds.columns.size(); ++i)
    EXPECT_NEAR(std::accumulate(beds.columns[i].begin(), beds.columns[i].end(), 0.0), 0, 1e-9);
}

TEST(RippleTheoryTest, says_what_it_cannot_do) {
  const Outcome without = run_program("ripple_theory");
  EXPECT_EQ(without.code, 1);
  EXPECT_NE(without.err.find("--out is required"), std::string::npos);
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  const Outcome onto_file = run_program("ripple_theory --out " + file);
  EXPECT_EQ(onto_file.code, 1);
  EXPECT_EQ(onto_file.err, "ripple_theory: cannot make the directory '" + file + "': Not a directory\n");
  const Outcome seed = run_program("ripple_theory --seed -x --out " + folder.file("out"));
  EXPECT_EQ(seed.code, 1);
  EXPECT_NE(seed.err.find("--seed"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
