#include "aeolian_core/grains/splash/coarse_sand.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

class Sample {
 public:
  void add(double x) {
    n_ += 1;
    sum_ += x;
    squares_ += x * x;
  }
  double mean() const { return sum_ / n_; }
  double deviation() const { return std::sqrt(squares_ / n_ - mean() * mean()); }

 private:
  double n_ = 0, sum_ = 0, squares_ = 0;
};

TEST(CoarseSandTest, every_setting_of_the_experiment_comes_out) {  // X1 and X2 of the specification
  const auto splash = splash_of("coarse_sand", "coarse_sand");
  for (const CoarseSandRow& row : coarse_sand_rows()) {
    SCOPED_TRACE(testing::Message() << row.speed << " cm/s, " << row.angle << " degrees");
    const Impact impact{row.speed / 100, row.angle * degree};
    RandomStream random(1, 1);
    SplashEvent event;
    Sample along, upward, number, up, energy;
    for (int i = 0; i < 10000; ++i) {
      splash->sample(impact, random, event);
      ASSERT_TRUE(event.rebound);
      along.add(event.rebound->velocity.x() / impact.speed / std::cos(impact.angle));
      upward.add(event.rebound->velocity.z() / impact.speed / std::sin(impact.angle));
      number.add(static_cast<double>(event.ejecta.size()));
      energy.add(kinetic_energy(event) / kinetic_energy(impact));
      for (const LeavingGrain& grain : event.ejecta) up.add(100 * grain.velocity.z());
    }
    const auto expect = [](const Sample& found, const CoarseSandRow::Spread& wanted) {
      EXPECT_NEAR(found.mean(), wanted.mean, 0.05 * wanted.mean);
      EXPECT_NEAR(found.deviation(), wanted.half_width, 0.15 * wanted.half_width);
    };
    expect(along, row.along);
    expect(upward, row.upward);
    expect(number, row.number);
    expect(up, row.ejecta_up);
    EXPECT_NEAR(energy.mean(), row.energy_ratio, 0.03);
  }
}

TEST(CoarseSandTest, number_goes_on_in_a_straight_line_down_to_the_threshold) {
  const CoarseSandEjection ejection(splash_material("coarse_sand").grain);
  EXPECT_NEAR(ejection.mean_number({6.5, 15 * degree}), 2.8, 1e-9);
  EXPECT_NEAR(ejection.mean_number({(6.5 + 3.4286) / 2, 15 * degree}), 1.4, 0.01);
  EXPECT_EQ(ejection.mean_number({3.4, 15 * degree}), 0);
  EXPECT_GT(ejection.mean_number({24, 15 * degree}), 2 * 5.7);
}

TEST(CoarseSandTest, speeds_scale_with_the_root_of_the_diameter) {
  const CoarseSandEjection coarse(splash_material("coarse_sand").grain);
  const CoarseSandEjection fine(splash_material("fine_sand").grain);
  const double ratio = std::sqrt(0.00025 / coarse_sand_diameter);
  std::vector<LeavingGrain> a, b;
  RandomStream one(2, 2), two(2, 2);
  coarse.sample({9, 0.25}, one, a);
  fine.sample({9 * ratio, 0.25}, two, b);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i].velocity.z(), ratio * a[i].velocity.z(), 1e-9);
}

TEST(CoarseSandTest, flat_impacts_rebound_higher) {
  const CoarseSandRebound rebound(splash_material("coarse_sand").grain);
  double last = 10;
  for (const double angle : {6.0, 10.0, 15.5, 21.0, 35.0}) {
    RandomStream random(1, 1);
    double upward = 0;
    const int count = 4000;
    for (int i = 0; i < count; ++i)
      if (const auto leaves = rebound.sample({9, angle * degree}, random))
        upward += leaves->velocity.z() / 9 / std::sin(angle * degree) / count;
    EXPECT_LT(upward, last) << angle;
    last = upward;
  }
}

}  // namespace
}  // namespace aeolian
