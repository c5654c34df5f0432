#include "aeolian_core/grains/splash/rebound_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr int rays = 20000;

ReboundModel::Means means(const ReboundModel::Parameters& p, double angle, double slope = 0,
                          double size = 1) {
  Impact impact{1, angle * degree};
  impact.slope = slope * degree;
  impact.size_ratio = size;
  return ReboundModel(p).means(impact, rays);
}

TEST(ReboundModelTest, mean_contact_angle_is_the_analytic_one) {
  for (const double angle : {5.0, 15.0, 25.0, 30.0})
    EXPECT_NEAR(means(ReboundModel::thesis_case(1), angle).contact_angle / degree,
                mean_contact_angle(angle * degree) / degree, 0.01)
        << angle;
  EXPECT_NEAR(mean_contact_angle(15 * degree) / degree, 12.85, 0.01);
}

TEST(ReboundModelTest, cases_of_the_thesis) {
  const ReboundModel::Means one = means(ReboundModel::thesis_case(1), 15);
  EXPECT_NEAR(one.upward, 0.969, 0.005 * 0.969);
  EXPECT_NEAR(one.along, 0.843, 0.005 * 0.843);
  EXPECT_NEAR(one.from_vertical / degree, 72.3, 0.1);
  EXPECT_NEAR(one.twice, 0.116, 0.001);
  const ReboundModel::Means two = means(ReboundModel::thesis_case(2), 25);
  EXPECT_NEAR(two.upward, 0.631, 0.005 * 0.631);
  EXPECT_NEAR(two.along, 0.561, 0.005 * 0.561);
}

TEST(ReboundModelTest, second_collisions_matter) {
  ReboundModel::Parameters once = ReboundModel::thesis_case(1);
  once.most_collisions = 1;
  EXPECT_NEAR(means(once, 15).upward, 0.842, 0.005 * 0.842);
}

TEST(ReboundModelTest, large_grains_of_the_same_density_are_captured) {
  ReboundModel::Parameters spheres = ReboundModel::thesis_case(1);
  spheres.mass_exponent = 3;
  EXPECT_NEAR(means(spheres, 15, 0, 0.25).upward, 2.189, 0.005 * 2.189);
  EXPECT_DOUBLE_EQ(means(spheres, 15, 0, 2).upward, 0);
  EXPECT_DOUBLE_EQ(means(spheres, 15, 0, 2).captured, 1);
}

TEST(ReboundModelTest, distribution_is_skewed_and_bounded) {
  const ReboundModel model(ReboundModel::thesis_case(1));
  std::vector<double> upward;
  double sum = 0, squares = 0;
  for (int i = 0; i < rays; ++i) {
    upward.push_back(model.bounce(15 * degree, 1, (i + 0.5) / rays).velocity.y() / std::sin(15 * degree));
    sum += upward.back();
    squares += upward.back() * upward.back();
  }
  std::sort(upward.begin(), upward.end());
  EXPECT_NEAR(upward[rays / 2], 1.068, 0.005);
  EXPECT_NEAR(upward.back(), 1.467, 0.005);
  EXPECT_NEAR(std::sqrt(squares / rays - sum * sum / rays / rays), 0.397, 0.003);
  const auto below = std::lower_bound(upward.begin(), upward.end(), 1.0) - upward.begin();
  EXPECT_NEAR(static_cast<double>(below) / rays, 0.446, 0.003);
}

TEST(ReboundModelTest, draws_have_the_means_of_the_rays) {
  const ReboundModel model(ReboundModel::Parameters{});
  const Impact impact{3, 12 * degree};
  const ReboundModel::Means expected = model.means(impact, rays);
  RandomStream random(1, 1);
  const int draws = 40000;
  double upward = 0;
  for (int i = 0; i < draws; ++i)
    if (const auto grain = model.sample(impact, random))
      upward += grain->velocity.z() / impact.speed / std::sin(impact.angle);
  EXPECT_NEAR(upward / draws, expected.upward, 4 * 0.5 / std::sqrt(draws));
}

TEST(ReboundModelTest, never_faster_than_the_impact) {
  RandomStream random(5, 1);
  for (int i = 0; i < 20000; ++i) {
    ReboundModel::Parameters p;
    p.restitution = random.uniform();
    p.friction_restitution = 2 * random.uniform() - 1;
    p.gap = 3 * random.uniform();
    p.mass = 0.2 + 5 * random.uniform();
    const double size = 0.1 + 9.9 * random.uniform();
    const auto bounce = ReboundModel(p).bounce(M_PI / 2 * random.uniform(), size, random.uniform());
    ASSERT_LE(bounce.velocity.norm(), 1 + 1e-12);
    ASSERT_EQ(bounce.captured, bounce.velocity.y() <= 0);
  }
}

TEST(ReboundModelTest, a_path_that_falls_back_onto_the_bed_is_mirrored) {
  const ReboundModel model(ReboundModel::Parameters{});
  Impact ahead{1, 50 * degree}, back{1, 80 * degree};  // 80 + 50 = 130 degrees to the bed: 50 from behind
  back.slope = 50 * degree;
  RandomStream one(3, 3), two(3, 3);
  for (int i = 0; i < 100; ++i) {
    const auto a = model.sample(ahead, one), b = model.sample(back, two);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    const Eigen::Vector3d v = b->velocity;  // on the bed: along -x turned by the slope
    EXPECT_NEAR(v.x() * std::cos(back.slope) + v.z() * std::sin(back.slope), -a->velocity.x(), 1e-9);
    EXPECT_NEAR(v.z() * std::cos(back.slope) - v.x() * std::sin(back.slope), a->velocity.z(), 1e-9);
  }
}

TEST(ReboundModelTest, refusals_name_parameter_and_value) {
  const auto refusal = [](void (*change)(ReboundModel::Parameters&)) {
    ReboundModel::Parameters p;
    change(p);
    return error_of([&] { ReboundModel model(p); });
  };
  EXPECT_EQ(refusal([](auto& p) { p.restitution = 1.5; }),
            "rebound model: restitution is 1.5, must be 0 to 1");
  EXPECT_NE(refusal([](auto& p) { p.gap = -1; }).find("gap is -1"), std::string::npos);
  EXPECT_NE(refusal([](auto& p) { p.mass = 0; }).find("effective mass"), std::string::npos);
  EXPECT_NE(refusal([](auto& p) { p.inertia = std::numeric_limits<double>::quiet_NaN(); }).find("inertia"),
            std::string::npos);
  EXPECT_NE(refusal([](auto& p) { p.most_collisions = 3; }).find("collisions"), std::string::npos);
  EXPECT_THROW(ReboundModel::thesis_case(3), Error);
}

}  // namespace
}  // namespace aeolian
