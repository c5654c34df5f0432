#include "aeolian_core/measure/ripple_tracking.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include "ripple_world.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.0025, 320, 160);  // 0.8 m x 0.4 m

int count(const RippleHistory& history, RippleChange kind) {
  return static_cast<int>(std::count_if(history.events.begin(), history.events.end(),
                                        [&](const RippleEvent& event) { return event.kind == kind; }));
}

std::string told(const RippleHistory& history) {
  std::string text;
  for (const RippleEvent& e : history.events)
    text += std::string(name_of(e.kind)) + " t " + std::to_string(e.start) + ".." + std::to_string(e.end) +
            " at " + std::to_string(e.place.x()) + "," + std::to_string(e.place.y()) + " length " +
            std::to_string(e.length) + "\n";
  return text;
}

class TravelDirection : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(RippleTracker, TravelDirection, testing::Values(0.0, 17.0, 30.0, 45.0));

// A third of a cell a step with noise of a tenth of the height, four with a quarter; holes. The wind blows 10
// degrees off.
TEST_P(TravelDirection, trains_have_their_speed) {
  for (const double way : {0.0007, 0.008}) {
    Train t;
    t.direction = GetParam() * degree;
    RippleTracker tracker(t.direction + 10 * degree);
    for (int m = 0; m < 6; ++m) {
      t.phase = 2 * M_PI / t.wavelength * way * m;
      HeightMap::Layer layer = laid_out(plot, t);
      add_noise(layer, (way < plot.cell() ? 0.1 : 0.25) * t.height, static_cast<std::uint64_t>(m));
      dig_holes(plot, layer, {{0.3, 0.2}, {0.6, 0.3}}, 0.04);
      tracker.add(plot, layer, 60.0 * m);
    }
    const RippleHistory history = tracker.history();
    // Within 2 %, or 0.1 mm over the series.
    EXPECT_NEAR(history.celerity.value, way / 60, std::max(0.02 * way, 1e-4 / 5) / 60);
    EXPECT_EQ(history.maps.size(), 6U);
    EXPECT_TRUE(history.events.empty()) << told(history);
    std::set<int> ids;
    for (const TrackedMap& map : history.maps)
      for (const CrestMotion& motion : map.motions) {
        ids.insert(motion.id);
        if (std::isfinite(motion.direction) && motion.speed.value > 0) {
          EXPECT_NEAR(std::remainder(motion.direction - t.direction, 2 * M_PI), 0, 20 * degree);
        }
      }
    // Ripples come in and go out at the borders while they move on by one.
    EXPECT_LT(ids.size(), history.maps.front().found.crests.size() + 12);
  }
}

/// Ripples with round crests on a flat bed, the highest of them everywhere: places, heights and half widths
/// [m].
struct Ripples {
  std::vector<double> place, height, width;
  double operator()(double x) const {
    double top = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const double u = (x - place[i]) / width[i];
      top = std::max(top, height[i] / (1 + u * u * u * u));
    }
    return top;
  }
  /// Whether the top of the last is above all others.
  bool shows_last() const { return (*this)(place.back()) <= height.back(); }
};

/// Even ripples of 4 mm at 8 cm, moving at 0.1 mm/s; between the fifth and the sixth a small one.
Ripples with_small_one(double time, double small_place) {
  Ripples r;
  for (int i = -2; i < 12; ++i) {
    r.place.push_back(0.03 + 0.08 * i + 1e-4 * time + (i >= 5 ? 0.05 : 0));
    r.height.push_back(0.004);
    r.width.push_back(0.022);
  }
  r.place.push_back(small_place);
  r.height.push_back(0.002);
  r.width.push_back(0.012);
  return r;
}

/// A small ripple three times as fast as the others climbs the one ahead.
Ripples overtaking(double time) { return with_small_one(time, 0.03 + 0.32 + 0.055 + 3e-4 * time); }

RippleHistory history_of(const std::function<Ripples(double)>& world, double duration, double step,
                         double noise, bool mirrored = false) {
  RippleTracker tracker(0);
  int number = 0;
  for (double time = 0; time <= duration; time += step) {
    const Ripples ripples = world(mirrored ? duration - time : time);
    HeightMap::Layer layer = laid_out(plot, [&](double x, double y) {
      const double bend = 0.01 * std::sin(2 * M_PI * y / 0.4);  // crests are not quite straight
      return ripples((mirrored ? plot.length_x() - x : x) - bend);
    });
    add_noise(layer, noise, static_cast<std::uint64_t>(++number));
    tracker.add(plot, layer, time);
  }
  return tracker.history();
}

/// When the top of the last ripple goes under.
double time_under(const std::function<Ripples(double)>& world) {
  double time = 0;
  while (world(time).shows_last()) time += 1;
  return time;
}

TEST(RippleTracker, a_small_ripple_merges_with_the_one_ahead) {
  const double truth = time_under(overtaking);
  ASSERT_GT(truth, 100);
  for (const double noise : {0.0, 3e-4}) {
    const RippleHistory history = history_of(overtaking, 400, 25, noise);
    ASSERT_EQ(count(history, RippleChange::merger), 1) << told(history);
    EXPECT_EQ(history.events.size(), 1U) << told(history);
    const RippleEvent& merger = history.events.front();
    // The trough between them is too shallow to be told when they have a fifth of a wavelength to go.
    EXPECT_NEAR(merger.time, truth, 0.02 / 2e-4);
    EXPECT_NEAR(merger.place.x(), overtaking(truth).place.back(), 0.03);
    EXPECT_GT(merger.length, 0.25);
  }
}

// The same film backwards, seen in a mirror, so that ripples still go downwind.
TEST(RippleTracker, a_ripple_splits_in_two) {
  const double truth = 400 - time_under(overtaking);
  const RippleHistory history = history_of(overtaking, 400, 25, 1e-4, true);
  ASSERT_EQ(count(history, RippleChange::split), 1) << told(history);
  EXPECT_EQ(history.events.size(), 1U) << told(history);
  EXPECT_NEAR(history.events.front().time, truth, 0.02 / 2e-4);
  EXPECT_NEAR(history.celerity.value, 1.1e-4, 0.2e-4);
}

/// A ripple of 4 mm and one of 2.5 mm ahead of it come as near as 38 mm and part with heights exchanged.
Ripples repelling(double time) {
  Ripples r;
  const double late = (time - 200) / 100;
  const double gap = 0.04 + 0.035 * (1 - 1 / (1 + late * late));
  const double over = 0.5 + 0.5 * std::tanh(2 * late);
  for (int i = -2; i < 12; ++i) {
    const double even = 0.03 + 0.08 * i + 1e-4 * time;
    r.place.push_back(i == 4 ? even + 0.5 * (0.08 - gap) : i == 5 ? even - 0.5 * (0.08 - gap) : even);
    r.height.push_back(i == 4 ? 0.004 - 0.0015 * over : i == 5 ? 0.0025 + 0.0015 * over : 0.004);
    r.width.push_back(0.016);
  }
  return r;
}

TEST(RippleTracker, two_ripples_repel_each_other) {
  const RippleHistory history = history_of(repelling, 400, 25, 1e-4);
  ASSERT_EQ(count(history, RippleChange::repulsion), 1) << told(history);
  EXPECT_EQ(history.events.size(), 1U) << told(history);
  const RippleEvent& repulsion = history.events.front();
  EXPECT_NEAR(repulsion.time, 200, 40);
  EXPECT_NEAR(repulsion.place.x(), 0.03 + 0.36 + 0.02, 0.02);
  EXPECT_LT(repulsion.ratio_before, 0.8);
  EXPECT_GT(repulsion.ratio_after, 1.25);
}

// One ripple is not seen on one map, another is seen there alone.
TEST(RippleTracker, a_flickering_detection_makes_no_events) {
  const auto world = [](double time) {
    Ripples r = with_small_one(time, 0.03 + 0.32 + 0.065 + 1e-4 * time);
    if (std::abs(time - 100) > 1) r.height.back() = 0;
    if (std::abs(time - 200) < 1) r.height[4] = 0;
    return r;
  };
  const RippleHistory history = history_of(world, 400, 25, 1e-4);
  EXPECT_TRUE(history.events.empty()) << told(history);
}

TEST(RippleTracker, follows_a_defect_that_climbs_along_the_crests) {
  RippleTracker tracker(0);
  for (int m = 0; m <= 10; ++m) {
    Train t;
    const double way = 0.004 * m;
    t.phase = 2 * M_PI / t.wavelength * way;
    t.dislocations = {{0.35 + way, 0.1 + 0.015 * m, 1}};
    tracker.add(plot, laid_out(plot, t), 30.0 * m);
  }
  const RippleHistory history = tracker.history();
  ASSERT_EQ(history.defects.size(), 1U);
  EXPECT_NEAR(history.defects.front().travel, 0.15, 0.02);
  ASSERT_GE(count(history, RippleChange::defect), 1) << told(history);
}

TEST(RippleTracker, ripples_may_come_late_or_not_at_all) {
  RippleTracker tracker(0);
  tracker.add(plot, HeightMap::Layer(plot.size(), 0.F), 0);
  EXPECT_TRUE(tracker.history().events.empty());
  EXPECT_TRUE(std::isnan(tracker.history().celerity.value));
  Train t;
  tracker.add(plot, laid_out(plot, t), 60);
  tracker.add(plot, laid_out(plot, t), 120);
  tracker.add(plot, HeightMap::Layer(plot.size(), 0.F), 180);
  const RippleHistory history = tracker.history();
  EXPECT_TRUE(history.events.empty()) << told(history);
  EXPECT_NEAR(history.celerity.value, 0, 1e-9);
}

TEST(RippleTracker, says_what_it_cannot_take) {
  EXPECT_THROW(RippleTracker(std::nan("")), Error);
  EXPECT_THROW(RippleTracker(0, -1), Error);
  RippleTracker tracker(0);
  tracker.add(plot, HeightMap::Layer(plot.size(), 0.F), 5);
  EXPECT_THROW(tracker.add(plot, HeightMap::Layer(plot.size(), 0.F), 5), Error);
  EXPECT_THROW(tracker.add(plot, HeightMap::Layer(plot.size(), 0.F), std::nan("")), Error);
  EXPECT_THROW(tracker.add(GridGeometry(0, 0, 0.002, 10, 10), HeightMap::Layer(100, 0.F), 6), Error);
}

}  // namespace
}  // namespace aeolian
