#include "aeolian_core/measure/registration.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "fusion_worlds.hpp"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
/// Height at (x, y) and its gradient.
using Bed = std::function<Eigen::Vector3d(double, double)>;

constexpr double noise = 0.001;
constexpr double amplitude = 0.004;

/// Ripples of 10 cm that lie across x, without any relief along y.
Eigen::Vector3d parallel_ripples(double x, double) {
  const double k = 2 * M_PI / 0.1;
  return {amplitude * std::sin(k * x), amplitude * k * std::cos(k * x), 0};
}

/// Ripples whose crests wind.
Eigen::Vector3d winding_ripples(double x, double y) {
  const double k = 2 * M_PI / 0.1;
  const double l = 2 * M_PI / 0.3;
  const double phase = k * x + 1.5 * std::sin(l * y);
  return {amplitude * std::sin(phase), amplitude * k * std::cos(phase),
          amplitude * std::cos(phase) * 1.5 * l * std::cos(l * y)};
}

Eigen::Vector3d level(double, double) { return Eigen::Vector3d::Zero(); }

struct Corner {
  double x = 0;
  double y = 0;
  double z = 0;  ///< of the bed's mean
};

HeightMap map_of(const Bed& bed, double map_noise, std::uint64_t seed, Corner corner = {}) {
  HeightMap map(GridGeometry(corner.x, corner.y, 0.002, 500, 500));
  HeightMap::Layer& elevation = map.add(layer::elevation);
  RandomStream random(seed, 1);
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    const CellIndex c = map.geometry().cell_at(i);
    const double height = bed(map.geometry().x(c.x) - corner.x, map.geometry().y(c.y) - corner.y)[0];
    elevation[i] = static_cast<float>(corner.z + height + map_noise * random.normal());
  }
  return map;
}

std::vector<Eigen::Vector3d> points_on(const Bed& bed, std::uint64_t seed, Corner corner = {}) {
  RandomStream random(seed, 2);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8000; ++i) {
    const double x = 0.1 + 0.8 * random.uniform();
    const double y = 0.1 + 0.8 * random.uniform();
    points.emplace_back(corner.x + x, corner.y + y, corner.z + bed(x, y)[0] + noise * random.normal());
  }
  return points;
}

/// A sensor 1.2 m over the middle of the map.
Eigen::Isometry3d true_pose(Corner corner = {}) {
  return looking_down(corner.x + 0.5, corner.y + 0.5, corner.z + 1.2);
}

/// Turns about the middle of the map, then shifts.
Eigen::Isometry3d move(const Eigen::Vector3d& shift, const Eigen::Vector3d& turn, Corner corner = {}) {
  const Eigen::Vector3d middle(corner.x + 0.5, corner.y + 0.5, corner.z);
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return Eigen::Translation3d(shift) * Eigen::Translation3d(middle) * rotation *
         Eigen::Translation3d(-middle);
}

const Eigen::Vector3d some_shift(0.006, -0.005, 0.004);
const Eigen::Vector3d some_turn(0.004, -0.006, 0.005);

/// What is left of a misalignment: translation of the middle of the map, rotation.
Vector6 error_of(const Eigen::Isometry3d& pose, Corner corner = {}) {
  const Eigen::Vector3d middle(corner.x + 0.5, corner.y + 0.5, corner.z);
  const Eigen::Isometry3d rest = pose * true_pose(corner).inverse();
  const Eigen::AngleAxisd turn(rest.linear());
  Vector6 error;
  error << rest * middle - middle, turn.angle() * turn.axis();
  return error;
}

/// Inverse covariance of the best possible estimate from these points (Cramer and Rao), from the bed's own
/// normals.
Matrix6 information_of(const Bed& bed, const std::vector<Eigen::Vector3d>& points) {
  Matrix6 information = Matrix6::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d h = bed(p.x(), p.y());
    const Eigen::Vector3d upward(-h[1], -h[2], 1);  // a height's error is noise, whatever the slope
    Vector6 row;
    row << upward, (p - Eigen::Vector3d(0.5, 0.5, 0)).cross(upward);
    information += row * row.transpose() / (noise * noise);
  }
  return information;
}

TEST(Registration, FindsAKnownMoveWithinItsStatisticalError) {
  const HeightMap map = map_of(winding_ripples, 0, 0);
  const RegistrationParameters parameters;
  double chi_square = 0;
  constexpr int seeds = 12;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const auto points = points_on(winding_ripples, seed);
    const double sign = seed % 2 == 0 ? 1 : -1;
    const Registration r =
        register_cloud(seen_from(true_pose(), points),
                       move(sign * some_shift, sign * some_turn) * true_pose(), map, parameters);
    ASSERT_TRUE(r.accepted) << r.reason;
    EXPECT_EQ(r.held, 6);
    EXPECT_EQ(r.pairs, points.size());
    EXPECT_NEAR(r.median_residual, 0.6745 * noise, 0.05 * noise);
    EXPECT_NEAR(r.angle, some_turn.norm(), 1e-3);
    EXPECT_GT(r.shift, some_shift.norm());  // the turn adds to it at the rim
    const Vector6 error = error_of(r.pose);
    chi_square += error.dot(information_of(winding_ripples, points) * error) / seeds;
  }
  // Six degrees of freedom, 95 % efficient: 6.3 +- 1.0 over twelve seeds.
  EXPECT_GT(chi_square, 3.3);
  EXPECT_LT(chi_square, 9.5);
}

TEST(Registration, FindsItOnANoisyMap) {
  const Registration r =
      register_cloud(seen_from(true_pose(), points_on(winding_ripples, 3)),
                     move(some_shift, some_turn) * true_pose(), map_of(winding_ripples, noise / 2, 4), {});
  ASSERT_TRUE(r.accepted) << r.reason;
  EXPECT_EQ(r.held, 6);
  const Vector6 error = error_of(r.pose);
  EXPECT_LT(error.head<2>().norm(), 0.0004);
  EXPECT_LT(std::abs(error[2]), 0.00005);
  EXPECT_LT(error.tail<3>().norm(), 0.001);
}

TEST(Registration, OnALevelBedItLiftsAndTiltsOnly) {
  for (const double map_noise : {0.0, noise}) {
    const Registration r =
        register_cloud(seen_from(true_pose(), points_on(level, 5)), move(some_shift, some_turn) * true_pose(),
                       map_of(level, map_noise, 6), {});
    ASSERT_TRUE(r.accepted) << r.reason;
    EXPECT_EQ(r.held, 3);
    const Vector6 error = error_of(r.pose);
    EXPECT_NEAR(error[0], some_shift.x(), 1e-4) << "slid along the bed";
    EXPECT_NEAR(error[1], some_shift.y(), 1e-4);
    EXPECT_NEAR(error[5], some_turn.z(), 1e-4);
    EXPECT_NEAR(error[2], 0, 5e-5);
    EXPECT_NEAR(error[3], 0, 2e-4);
    EXPECT_NEAR(error[4], 0, 2e-4);
  }
}

TEST(Registration, AlongParallelRipplesTheCloudStaysAsGiven) {
  for (const auto method : {RegistrationMethod::icp, RegistrationMethod::ndt}) {
    RegistrationParameters parameters;
    parameters.method = method;
    const Registration r =
        register_cloud(seen_from(true_pose(), points_on(parallel_ripples, 7)),
                       move(some_shift, some_turn) * true_pose(), map_of(parallel_ripples, 0, 0), parameters);
    ASSERT_TRUE(r.accepted) << r.reason;
    EXPECT_EQ(r.held, 5);
    const Vector6 error = error_of(r.pose);
    EXPECT_NEAR(error[1], some_shift.y(), 2e-4);
    EXPECT_NEAR(error[0], 0, 3e-4);
    EXPECT_NEAR(error[2], 0, 1e-4);
  }
}

TEST(Registration, OutliersDoNotCount) {
  auto points = points_on(winding_ripples, 8);
  RandomStream random(8, 3);
  for (std::size_t i = 0; i < points.size(); i += 10) points[i].z() += 0.1 * random.uniform();  // in flight
  for (const auto method : {RegistrationMethod::icp, RegistrationMethod::ndt}) {
    RegistrationParameters parameters;
    parameters.method = method;
    const Registration r =
        register_cloud(seen_from(true_pose(), points), move(some_shift, some_turn) * true_pose(),
                       map_of(winding_ripples, 0, 0), parameters);
    ASSERT_TRUE(r.accepted) << r.reason;
    const Vector6 error = error_of(r.pose);
    EXPECT_LT(error.head<2>().norm(), 0.0005);
    EXPECT_LT(std::abs(error[2]), 0.0001);
    EXPECT_LT(error.tail<3>().norm(), 0.001);
  }
}

TEST(Registration, GeoreferencedCoordinatesLoseNothing) {
  const Corner corner{512000, 5403000, 310};
  PointCloud cloud;
  cloud.origin_x = corner.x;
  cloud.origin_y = corner.y;
  cloud.origin_z = corner.z;
  const Eigen::Isometry3d wrong = move(some_shift, some_turn, corner);
  for (const Eigen::Vector3d& p : points_on(winding_ripples, 9, corner)) {
    const Eigen::Vector3f q = (p - Eigen::Vector3d(corner.x, corner.y, corner.z)).cast<float>();
    cloud.push_back(q.x(), q.y(), q.z());
  }
  const Registration r = register_cloud(cloud, wrong, map_of(winding_ripples, 0, 0, corner), {});
  ASSERT_TRUE(r.accepted) << r.reason;
  const Eigen::Vector3d middle(corner.x + 0.5, corner.y + 0.5, corner.z);
  EXPECT_LT((r.pose * middle - middle).norm(), 0.0003);
}

TEST(Registration, AnAlignedCloudStays) {
  const Registration r = register_cloud(seen_from(true_pose(), points_on(winding_ripples, 10)), true_pose(),
                                        map_of(winding_ripples, 0, 0), {});
  EXPECT_TRUE(r.accepted) << r.reason;
  EXPECT_LT(r.shift, 0.0005);
}

TEST(Registration, TheSameInputsGiveTheSameBits) {
  const HeightMap map = map_of(winding_ripples, noise, 0);
  const PointCloud cloud = seen_from(true_pose(), points_on(winding_ripples, 11));
  const Eigen::Isometry3d given = move(some_shift, some_turn) * true_pose();
  for (const auto method : {RegistrationMethod::icp, RegistrationMethod::ndt}) {
    RegistrationParameters parameters;
    parameters.method = method;
    parameters.max_points = 3000;
    EXPECT_TRUE((register_cloud(cloud, given, map, parameters).pose.matrix().array() ==
                 register_cloud(cloud, given, map, parameters).pose.matrix().array())
                    .all());
  }
}

void expect_refused(const Registration& r, const Eigen::Isometry3d& given, const std::string& why) {
  EXPECT_FALSE(r.accepted);
  EXPECT_NE(r.reason.find(why), std::string::npos) << r.reason;
  EXPECT_TRUE(r.pose.matrix() == given.matrix());
}

TEST(Registration, RefusesToMoveBeyondItsBounds) {
  const HeightMap map = map_of(winding_ripples, 0, 0);
  const PointCloud cloud = seen_from(true_pose(), points_on(winding_ripples, 12));
  const Eigen::Isometry3d given = move(some_shift, some_turn) * true_pose();
  RegistrationParameters parameters;
  parameters.max_shift = 0.005;
  expect_refused(register_cloud(cloud, given, map, parameters), given, "would move a point of the cloud by");
  parameters.max_shift = 0.05;
  parameters.max_angle = 0.005;
  expect_refused(register_cloud(cloud, given, map, parameters), given, "would turn the cloud by");
}

TEST(Registration, RefusesWhatCannotBeRegistered) {
  const HeightMap map = map_of(winding_ripples, 0, 0);
  const PointCloud cloud = seen_from(true_pose(), points_on(winding_ripples, 13));
  const Eigen::Isometry3d given = true_pose();
  PointCloud unseen;
  for (int i = 0; i < 1000; ++i) unseen.push_back(NAN, NAN, NAN);
  const std::string few = "0 points of the cloud lie within";
  expect_refused(register_cloud(PointCloud(), given, map, {}), given, few);
  expect_refused(register_cloud(unseen, given, map, {}), given, few);
  const Eigen::Isometry3d beside = Eigen::Translation3d(5, 0, 0) * given;
  expect_refused(register_cloud(cloud, beside, map, {}), beside, few);
  const Eigen::Isometry3d above = Eigen::Translation3d(0, 0, 1) * given;
  expect_refused(register_cloud(cloud, above, map, {}), above, few);
  HeightMap unknown(map.geometry());
  unknown.add(layer::elevation);
  expect_refused(register_cloud(cloud, given, unknown, {}), given, few);
  HeightMap tiny(GridGeometry(0.5, 0.5, 0.002, 2, 2));
  tiny.add(layer::elevation, 0);
  expect_refused(register_cloud(cloud, given, tiny, {}), given, few);
}

TEST(Registration, NamesInputsThatCannotBe) {
  const HeightMap map = map_of(level, 0, 0);
  const auto throws = [&](const PointCloud& cloud, const Eigen::Isometry3d& pose, const HeightMap& onto,
                          const RegistrationParameters& parameters, const std::string& what) {
    try {
      register_cloud(cloud, pose, onto, parameters);
      ADD_FAILURE() << "no error: " << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const PointCloud none;
  PointCloud uneven;
  uneven.x.push_back(0);
  throws(uneven, true_pose(), map, {}, "1 x, 0 y and 0 z");
  Eigen::Isometry3d nowhere = true_pose();
  nowhere.translation().x() = NAN;
  throws(none, nowhere, map, {}, "pose of the sensor is not finite");
  throws(none, true_pose(), HeightMap(map.geometry()), {}, "elevation");
  RegistrationParameters parameters;
  parameters.max_shift = -1;
  throws(none, true_pose(), map, parameters, "max_shift is -1, must be positive");
  parameters = {};
  parameters.max_distance = NAN;
  throws(none, true_pose(), map, parameters, "max_distance is nan");
  parameters = {};
  parameters.max_points = 100;
  throws(none, true_pose(), map, parameters, "max_points is 100, must be at least min_pairs");
}

}  // namespace
}  // namespace aeolian
