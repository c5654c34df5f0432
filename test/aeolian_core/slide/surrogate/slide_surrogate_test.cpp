#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"

#include <cmath>

#include "../../../error_of.hpp"
#include "../../../temporary_folder.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/slide/surrogate/pile_design.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

PileDesign design() {
  PileDesign d;
  d.panel_length = {0.5, 4};
  d.panel_height = {1, 3};
  d.tilt = {40 * degree, 60 * degree};
  d.thickness = {0.05, 0.05};
  d.runs = 40;
  return d;
}

/// Piles by a law of powers, as they are known to grow (specification, 5 B and D), each off by as much.
PileTable world(double noise, std::uint64_t seed = 5) {
  RandomStream random(seed, 0);
  PileTable table;
  int run = 0;
  for (PileQuery query : panels_of(design())) {
    for (query.event = 1; query.event <= 5; ++query.event) {
      PileRecord r{run, query, 0.0125};
      r.height = 0.06 * std::sqrt(query.event * query.panel_length) * std::exp(noise * random.normal());
      r.length = 1.2 * std::pow(query.panel_length, 0.3) * std::pow(query.panel_height, 0.4) *
                 std::exp(noise * random.normal());
      r.tail = r.length;
      table.push_back(r);
    }
    ++run;
  }
  return table;
}

SlideSurrogate::Settings quick(SvrKernel kernel) {
  SlideSurrogate::Settings settings;
  settings.kernel = kernel;
  settings.grid = {{0.03}, {1}, {10}, {0.03}};
  return settings;
}

TEST(SlideSurrogate, KnowsPilesThatItHasNotSeen) {
  for (const SvrKernel kernel : {SvrKernel::linear, SvrKernel::rbf}) {
    const auto surrogate = SlideSurrogate::train(world(0.02), quick(kernel));
    const PileQuery query{1.7, 2.2, 47 * degree, 0.05, 3};
    const auto pile = surrogate.predict(query);
    ASSERT_TRUE(pile);
    const double height = 0.06 * std::sqrt(3 * 1.7), length = 1.2 * std::pow(1.7, 0.3) * std::pow(2.2, 0.4);
    EXPECT_NEAR(pile->height.value, height, 0.03 * height);
    EXPECT_NEAR(pile->length.value, length, 0.03 * length);
    EXPECT_NEAR(pile->shape.value, height / length, 0.05 * height / length);
    EXPECT_LT(pile->height.low, pile->height.value);
    EXPECT_GT(pile->height.high, pile->height.value);
  }
}

TEST(SlideSurrogate, ItsIntervalHoldsAsOftenAsItSays) {
  const auto surrogate = SlideSurrogate::train(world(0.1), quick(SvrKernel::linear));
  int held = 0, all = 0;
  for (std::uint64_t seed = 100; seed < 105; ++seed)
    for (const PileRecord& r : world(0.1, seed)) {
      const auto pile = surrogate.predict(r.query);
      ASSERT_TRUE(pile);
      held += pile->height.low <= r.height && r.height <= pile->height.high ? 1 : 0;
      ++all;
    }
  EXPECT_NEAR(static_cast<double>(held) / all, 0.9, 0.05);
}

TEST(SlideSurrogate, OutsideItsTableItSaysNothingButWhy) {
  const auto surrogate = SlideSurrogate::train(world(0.02), quick(SvrKernel::rbf));
  const PileQuery inside{2, 1, 40 * degree, 0.05, 3};
  EXPECT_TRUE(surrogate.predict(inside));
  const auto refused = [&](PileQuery query) {
    EXPECT_FALSE(surrogate.predict(query));
    return surrogate.why_outside(query);
  };
  PileQuery query = inside;
  query.panel_length = 5;
  EXPECT_EQ(refused(query), "panel length is 5 m, the table has 0.5 to 4 m");
  query = inside;
  query.tilt = 65 * degree;
  EXPECT_EQ(refused(query), "tilt is 65 degrees, the table has 40 to 60 degrees");
  query = inside;
  query.thickness = 0.051;
  EXPECT_EQ(refused(query), "thickness is 0.051 m, the table has 0.05 to 0.05 m");
  query = inside;
  query.event = 6;
  EXPECT_EQ(refused(query), "event is 6, the table has 1 to 5");
}

TEST(SlideSurrogate, ReadsBackToTheSameBits) {
  const TemporaryFolder folder;
  for (const SvrKernel kernel : {SvrKernel::linear, SvrKernel::rbf}) {
    const auto written = SlideSurrogate::train(world(0.05), quick(kernel));
    written.write(folder.file("s.yaml"), "made by a test");
    const auto read = SlideSurrogate::read(folder.file("s.yaml"));
    const PileQuery query{1.3, 2.9, 59 * degree, 0.05, 4};
    const auto a = written.predict(query), b = read.predict(query);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->shape.value, b->shape.value);
    EXPECT_EQ(a->length.low, b->length.low);
    EXPECT_EQ(read.coverage(), 0.9);
    EXPECT_EQ(read.kernel(), kernel);
  }
}

TEST(SlideSurrogate, RefusesFilesAndTablesThatCannotBe) {
  const TemporaryFolder folder;
  SlideSurrogate::train(world(0.05), quick(SvrKernel::linear)).write(folder.file("s.yaml"), "made by a test");
  std::string text = content_of(folder.file("s.yaml"));
  text.replace(text.find("kernel: linear"), 14, "kernel: quartic");
  const std::string bad = folder.write("bad.yaml", text);
  EXPECT_EQ(error_of([&] { SlideSurrogate::read(bad); }),
            bad + ":4: kernel is 'quartic', must be linear or rbf");
  EXPECT_EQ(error_of([&] { SlideSurrogate::train({}, {}); }),
            "surrogate: there are 0 piles, must be at least 1");
  PileTable few = world(0.05);
  few.resize(20);
  EXPECT_EQ(error_of([&] { SlideSurrogate::train(few, {}); }),
            "cross-validation: number of folds is 10, must be from 2 to the number of runs");
}

}  // namespace
}  // namespace aeolian
