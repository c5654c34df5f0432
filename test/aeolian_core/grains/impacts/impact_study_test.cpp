#include "aeolian_core/grains/impacts/impact_study.hpp"

#include "small_bed.hpp"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aeolian_core/grains/impacts/impact_statistics.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const std::vector<Bed<2>>& beds() {
  static const std::vector<Bed<2>> two = {make_bed(small_recipe(), soft_discs(), 1),
                                          make_bed(small_recipe(), soft_discs(), 2)};
  return two;
}

ImpactSeries short_series(int impacts) {
  ImpactSeries series;
  series.speed = 6;
  series.impacts = impacts;
  series.spread = 5;
  return series;
}

std::vector<double> numbers_of(const std::vector<ImpactOutcome>& outcomes) {
  std::vector<double> result;
  for (const ImpactOutcome& o : outcomes) {
    result.push_back(o.shot.along);
    result.push_back(o.rebound ? o.rebound->velocity.x() : 0);
    for (const RisenGrain& g : o.ejecta) result.push_back(g.velocity.z());
  }
  return result;
}

TEST(ImpactStudy, ThreadsDoNotMatter) {
  const auto with_threads = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return numbers_of(fire_series(beds(), short_series(6), {}));
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

TEST(ImpactStudy, ALongerSeriesBeginsWithTheShorterOne) {
  const auto some = fire_series(beds(), short_series(2), {});
  const auto more = fire_series(beds(), short_series(4), {});
  ASSERT_EQ(some.size(), 2U);
  ASSERT_EQ(more.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(some[i].shot.along, more[i].shot.along);
    EXPECT_EQ(some[i].contact->target, more[i].contact->target);
  }
}

TEST(ImpactStudy, StopsAndKeepsWhatIsDone) {
  std::atomic<bool> stop{false};
  const auto outcomes = fire_series<2>(
      beds(), short_series(500), {}, [&](const ImpactOutcome&, int over) { stop = over >= 3; }, &stop);
  EXPECT_GE(outcomes.size(), 3U);
  EXPECT_LE(outcomes.size(), 40U);
  for (const ImpactOutcome& outcome : outcomes) EXPECT_TRUE(outcome.contact);
}

TEST(ImpactStudy, TakesOverWhatIsKnown) {
  const auto all = fire_series(beds(), short_series(5), {});
  std::vector<ImpactOutcome> known = {all[3], all[1]};
  known[0].steps = -1;  // none that is fired has this
  int fired = 0;
  const auto count = [&](const ImpactOutcome& outcome, int over) {
    EXPECT_NE(outcome.number, 1);
    EXPECT_NE(outcome.number, 3);
    EXPECT_EQ(over, 2 + ++fired);
  };
  const auto outcomes = fire_series(beds(), short_series(5), {}, count, nullptr, known);
  EXPECT_EQ(fired, 3);
  ASSERT_EQ(outcomes.size(), 5U);
  EXPECT_EQ(outcomes[3].steps, -1);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(outcomes[i].shot.along, all[i].shot.along);
  // A shorter series has fewer of them.
  EXPECT_EQ(fire_series(beds(), short_series(2), {}, {}, nullptr, known).size(), 2U);
}

TEST(ImpactStudy, NeedsABed) { EXPECT_THROW(fire_series<2>({}, short_series(1), {}), Error); }

TEST(ImpactStatistics, PooledErrorCountsGroups) {
  const MeanValue one_each = mean_value({1, 2, 3, 4});
  EXPECT_EQ(one_each.mean, 2.5);
  EXPECT_NEAR(one_each.half_width, std::sqrt(5. / 3), 1e-12);
  EXPECT_NEAR(one_each.error, std::sqrt(5. / 3 / 4), 1e-12);
  // Twins in each group: as many values again, and no more is known.
  const MeanValue twins = pooled_mean({{1, 1}, {2, 2}, {3, 3}, {4, 4}});
  EXPECT_EQ(twins.mean, 2.5);
  EXPECT_NEAR(twins.error, one_each.error, 1e-12);
  EXPECT_TRUE(std::isnan(pooled_mean({{}, {}}).mean));
}

TEST(ImpactStatistics, OneEventByHand) {
  ImpactOutcome o;
  o.shot.speed = 10;
  o.shot.angle = M_PI / 6;
  o.contact = FirstContact{};
  o.contact->normal_angle = 0.2;
  o.contact->effective_mass = 2;
  RisenGrain rebound{};
  rebound.velocity = {5, 0, 5};
  rebound.radius = 0.01;
  rebound.spin = 250;
  o.rebound = rebound;
  RisenGrain ejectum{};
  ejectum.velocity = {-1, 0, 1};
  ejectum.radius = 0.01;
  ejectum.origin = {0.02, 0, -0.01};
  ejectum.layer = 2;
  ejectum.kind = Origin::target;
  o.ejecta = {ejectum, ejectum};
  ImpactOutcome captured = o;
  captured.rebound.reset();
  captured.ejecta.clear();
  const ImpactOutcome missed{};
  const ImpactStatistics s = impact_statistics({o, captured, missed}, beds()[0]);
  EXPECT_EQ(s.impacts, 2);
  EXPECT_EQ(s.captured, 1);
  EXPECT_NEAR(s.along.mean, 5 / (10 * std::cos(M_PI / 6)), 1e-12);
  EXPECT_NEAR(s.up.mean, 1, 1e-12);
  EXPECT_NEAR(s.rebound_angle.mean, M_PI / 4, 1e-12);
  EXPECT_NEAR(s.rolling.mean, 0.5, 1e-12);
  EXPECT_NEAR(s.bed_angle.mean, std::atan2(10., 10 * std::cos(M_PI / 6) - 5), 1e-12);
  EXPECT_EQ(s.number.mean, 1);
  EXPECT_NEAR(s.reptation.mean, -2 / gravity, 1e-12);
  EXPECT_NEAR(s.ejecta_angle.mean, -M_PI / 4, 1e-12);
  EXPECT_NEAR(s.ejected_energy.mean, 0.5 * 4 / 100, 1e-12);
  EXPECT_EQ(s.from_upper_layers, 1);
  EXPECT_EQ(s.by_origin.at(Origin::target).number.mean, 1);
  EXPECT_EQ(s.by_origin.at(Origin::brink).number.mean, 0);
}

}  // namespace
}  // namespace aeolian
