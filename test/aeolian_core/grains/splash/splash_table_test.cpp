#include "aeolian_core/grains/splash/splash_table.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "../../../error_of.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double unit() { return std::sqrt(gravity * Grain{}.diameter); }

Impact impact_at(double speed, double angle, double size = 1, double roughness = 0) {
  Impact impact{speed * unit(), angle * degree};
  impact.size_ratio = size;
  impact.roughness = roughness;
  return impact;
}

/// `count` ejecta straight up at `up` sqrt(g d), the grain rebounds at `ratio` of its speed.
SplashEvent event_of(const Impact& impact, double ratio, int count, double up) {
  SplashEvent event;
  event.rebound = LeavingGrain{{ratio * impact.speed, 0, 0.2 * impact.speed}, impact.size_ratio};
  event.ejecta.assign(static_cast<std::size_t>(count),
                      {{0, 0, up * unit()}, 1, 3 * Grain{}.diameter, Origin::target});
  return event;
}

/// Two speeds and two angles with other numbers, ratios and speeds of ejecta each.
std::vector<SplashCase> cases() {
  std::vector<SplashCase> all;
  for (const double speed : {60.0, 100.0})
    for (const double angle : {10.0, 20.0}) {
      const Impact impact = impact_at(speed, angle);
      const int number = (speed == 60 ? 1 : 3) + (angle == 10 ? 0 : 2);
      const double ratio = 0.4 + speed / 1000 + angle / 100;
      all.push_back({impact, {event_of(impact, ratio, number, 1 + angle / 10)}});
    }
  return all;
}

SplashTableSource source() { return {"a command --with flags", "sand, 0.25 mm", 1}; }

std::shared_ptr<const SplashTable> table() {
  return std::make_shared<SplashTable>(SplashTable::build(cases(), Grain{}.diameter, source()));
}

struct File {
  std::string path = testing::TempDir() + "splash_table_test.csv";
  ~File() { std::remove(path.c_str()); }
  std::string text() const {
    std::ifstream file(path);
    std::ostringstream all;
    all << file.rdbuf();
    return all.str();
  }
  void replace(const std::string& from, const std::string& to) const {
    std::string all = text();
    const std::size_t at = all.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    all.replace(at, from.size(), to);
    std::ofstream(path) << all;
  }
};

TEST(SplashTableTest, at_a_node_events_come_out_as_they_went_in) {
  const TabulatedSplash splash(table(), Grain{});
  RandomStream random(1, 1);
  for (const SplashCase& one : cases()) {
    const SplashEvent event = splash.sample(one.impact, random);
    ASSERT_EQ(event.ejecta.size(), one.events[0].ejecta.size());
    EXPECT_NEAR((event.rebound->velocity - one.events[0].rebound->velocity).norm(), 0,
                2e-4 * one.impact.speed);
    EXPECT_NEAR((event.ejecta[0].velocity - one.events[0].ejecta[0].velocity).norm(), 0, 1e-4 * unit());
    EXPECT_EQ(event.ejecta[0].origin, Origin::target);
    EXPECT_NEAR(event.ejecta[0].distance, 3 * Grain{}.diameter, 1e-9);
  }
}

TEST(SplashTableTest, between_nodes_means_are_linear_and_events_are_not_mixed) {
  const TabulatedSplash splash(table(), Grain{});
  RandomStream random(1, 1);
  const Impact impact = impact_at(70, 17.5);  // a quarter of the way up in speed, three quarters in angle
  double number = 0;
  std::set<std::size_t> numbers;
  const int count = 40000;
  for (int i = 0; i < count; ++i) {
    const SplashEvent event = splash.sample(impact, random);
    number += static_cast<double>(event.ejecta.size());
    numbers.insert(event.ejecta.size());
    for (const LeavingGrain& grain : event.ejecta) {
      const double up = grain.velocity.z() / unit();
      ASSERT_TRUE(std::abs(up - 2) < 1e-3 || std::abs(up - 3) < 1e-3) << up;
    }
  }
  EXPECT_EQ(numbers, (std::set<std::size_t>{1, 3, 5}));
  EXPECT_NEAR(number / count, 1 + 2 * 0.25 + 2 * 0.75, 0.03);
  EXPECT_NEAR(splash.mean_ejecta(impact), 3, 1e-9);
}

TEST(SplashTableTest, rebounds_scale_with_speed_and_ejecta_do_not) {
  const TabulatedSplash splash(table(), Grain{});
  RandomStream random(1, 1);
  const Impact fast = impact_at(400, 10);
  const SplashEvent event = splash.sample(fast, random);
  EXPECT_NEAR(event.rebound->velocity.x() / fast.speed, 0.4 + 0.1 + 0.1, 2e-4);
  for (const LeavingGrain& grain : event.ejecta) EXPECT_NEAR(grain.velocity.z() / unit(), 2, 1e-3);
}

TEST(SplashTableTest, beyond_its_speeds_the_number_follows_its_own_line) {
  // Mean numbers 2 at 60 and 4 at 100: N = (v - 20) / 20.
  const auto one = table();
  EXPECT_NEAR(one->threshold(), 20, 1e-9);
  const TabulatedSplash splash(one, Grain{});
  RandomStream random(1, 1);
  for (const double speed : {15.0, 40.0, 180.0}) {
    double number = 0;
    const int count = 10000;
    for (int i = 0; i < count; ++i)
      number += static_cast<double>(splash.sample(impact_at(speed, 10), random).ejecta.size());
    const double at_edge = speed < 60 ? 1 : 3;
    const double factor = speed < 60 ? std::max(0.0, (speed - 20) / 40) : (speed - 20) / 80;
    EXPECT_NEAR(number / count, at_edge * factor, 0.03 * at_edge * factor + 0.02) << speed;
    EXPECT_NEAR(splash.mean_ejecta(impact_at(speed, 10)), at_edge * factor, 1e-9);
  }
}

TEST(SplashTableTest, slopes_turn_the_whole_event) {
  const TabulatedSplash splash(table(), Grain{});
  Impact sloping = impact_at(60, 4);
  sloping.slope = 6 * degree;
  RandomStream one(1, 1), two(1, 1);
  const SplashEvent level = splash.sample(impact_at(60, 10), one), turned = splash.sample(sloping, two);
  const auto expect = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    EXPECT_NEAR(b.x(), a.x() * std::cos(sloping.slope) - a.z() * std::sin(sloping.slope), 1e-9);
    EXPECT_NEAR(b.z(), a.x() * std::sin(sloping.slope) + a.z() * std::cos(sloping.slope), 1e-9);
  };
  expect(level.rebound->velocity, turned.rebound->velocity);
  expect(level.ejecta.at(0).velocity, turned.ejecta.at(0).velocity);
}

TEST(SplashTableTest, tables_of_sloping_impacts_are_those_of_level_ones) {
  SplashCase level = cases()[0], sloping = level;
  sloping.impact.slope = 4 * degree;
  sloping.impact.angle -= 4 * degree;
  const auto turn = [&](Eigen::Vector3d& v) {
    v = Eigen::AngleAxisd(-4 * degree, Eigen::Vector3d::UnitY()) * v;
  };
  turn(sloping.events[0].rebound->velocity);
  for (LeavingGrain& grain : sloping.events[0].ejecta) turn(grain.velocity);
  const auto both = SplashTable::build({level, sloping}, Grain{}.diameter, source());
  EXPECT_EQ(both.axis(SplashTable::angle).size(), 1U);
  EXPECT_EQ(both.events(), 2U);
}

TEST(SplashTableTest, ejecta_are_thinned_to_the_share_kept) {
  const Impact impact = impact_at(80, 12);
  SplashCase many{impact, std::vector<SplashEvent>(2000, event_of(impact, 0.5, 5, 1))};
  SplashTableSource thinned = source();
  thinned.ejecta_kept = 0.35;
  const auto one = SplashTable::build({many}, Grain{}.diameter, thinned);
  EXPECT_NEAR(static_cast<double>(one.ejecta()) / 2000, 5 * 0.35, 4 * std::sqrt(5 * 0.35 * 0.65 / 2000));
  const auto again = SplashTable::build({many}, Grain{}.diameter, thinned);
  const auto other = SplashTable::build({many}, Grain{}.diameter, thinned, 2);
  EXPECT_EQ(one.ejecta(), again.ejecta());
  EXPECT_NE(one.ejecta(), other.ejecta());
}

TEST(SplashTableTest, no_event_has_more_than_its_impact) {
  const TabulatedSplash splash(table(), Grain{});
  RandomStream random(1, 1);
  for (int i = 0; i < 5000; ++i) {
    Impact impact = impact_at(0.5 + 200 * random.uniform(), 1 + 89 * random.uniform());
    impact.size_ratio = 0.1 + random.uniform();
    const SplashEvent event = splash.sample(impact, random);
    ASSERT_LE(kinetic_energy(event), kinetic_energy(impact) * (1 + 1e-9));
    ASSERT_LE(momentum_along(impact, event), momentum(impact) * (1 + 1e-9));
  }
}

TEST(SplashTableTest, files_read_back_to_the_same_draws) {
  const File file;
  const auto made = table();
  made->write(file.path);
  const auto read = std::make_shared<SplashTable>(SplashTable::read(file.path));
  EXPECT_EQ(read->source().command, "a command --with flags");
  EXPECT_EQ(read->source().material, "sand, 0.25 mm");
  EXPECT_EQ(read->events(), made->events());
  EXPECT_EQ(read->ejecta(), made->ejecta());
  const TabulatedSplash one(made, Grain{}), two(read, Grain{});
  RandomStream a(1, 1), b(1, 1);
  for (int i = 0; i < 200; ++i)
    EXPECT_NEAR(kinetic_energy(one.sample(impact_at(77, 14), a)),
                kinetic_energy(two.sample(impact_at(77, 14), b)), 1e-9);
  const std::string before = file.text();
  read->write(file.path);
  EXPECT_EQ(file.text(), before);
}

TEST(SplashTableTest, a_node_without_events_is_named) {
  std::vector<SplashCase> holed = cases();
  holed.pop_back();
  EXPECT_EQ(error_of([&] { SplashTable::build(holed, Grain{}.diameter, source()); }),
            "splash table: there are no events at speed 100 sqrt(g d), angle 20 degrees, size ratio 1, "
            "roughness 0, must be some at every node of the grid");
  EXPECT_NE(error_of([&] { SplashTable::build({}, Grain{}.diameter, source()); }).find("no nodes"),
            std::string::npos);
}

TEST(SplashTableTest, bad_builds_are_refused) {
  EXPECT_NE(error_of([] { SplashTable::build(cases(), 0, source()); }).find("diameter is 0"),
            std::string::npos);
  EXPECT_NE(error_of([] {
              SplashTable::build(cases(), 1e-3, {"a", "b", 1.5});
            }).find("1.5"),
            std::string::npos);
  EXPECT_NE(error_of([] {
              SplashTable::build(cases(), 1e-3, {"a\nb", "c", 1});
            }).find("one line"),
            std::string::npos);
  std::vector<SplashCase> fast = cases();
  fast[0].events[0].rebound->velocity *= 3;
  EXPECT_NE(
      error_of([&] { SplashTable::build(fast, Grain{}.diameter, source()); }).find("must not be faster"),
      std::string::npos);
  EXPECT_THROW(TabulatedSplash(nullptr, Grain{}), Error);
}

TEST(SplashTableTest, bad_files_are_refused_with_file_line_and_value) {
  const struct {
    const char *from, *to, *told;
  } all[] = {
      {"# aeolian splash table 1", "# a table", "1: is '# a table', must be '# aeolian splash table 1'"},
      {"command: a command --with flags\n", "", "the head has no 'command: '"},
      {"ejecta_kept: 1", "ejecta_kept: all", "ejecta_kept is 'all'"},
      {"events: 4", "events: four", "events is 'four'"},
      {"rebound,0.56", "rebound,x", "15: velocity along is 'x', must be -1 to 1"},
      {"rebound,0.56", "rebound,1.5", "velocity along is '1.5'"},
      {"rebound,0.56", "rebound,1", "faster than the impact"},
      {"rebound,0.56", "bounce,0.56", "row begins with 'bounce'"},
      {"target,0,0,", "target,0,", "has 5 fields, must be 6"},
      {",10,1,0,1\n", ",10,1,0,2\n", "has 1 events, must be 2"},
      {",10,1,0,1\n", ",100,1,0,1\n", "angle is '100'"},
      {"ejecta: 12", "ejecta: 13", "12 ejecta, must be 4, 4 and 13 as the head says"},
  };
  for (const auto& one : all) {
    const File file;
    table()->write(file.path);
    file.replace(one.from, one.to);
    const std::string told = error_of([&] { SplashTable::read(file.path); });
    EXPECT_EQ(told.find(file.path), 0U) << told;
    EXPECT_NE(told.find(one.told), std::string::npos) << told << "\n" << file.text();
  }
  EXPECT_NE(error_of([] { SplashTable::read("/nonexistent/table.csv"); }).find("/nonexistent/table.csv"),
            std::string::npos);
}

TEST(SplashTableTest, a_truncated_file_is_refused) {
  const File file;
  table()->write(file.path);
  const std::string all = file.text();
  std::ofstream(file.path) << all.substr(0, all.size() * 3 / 4);
  EXPECT_THROW(SplashTable::read(file.path), Error);
}

}  // namespace
}  // namespace aeolian
