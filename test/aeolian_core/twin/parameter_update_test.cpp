#include "aeolian_core/twin/parameter_update.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd normals(Index rows, Index columns, std::uint64_t stream) {
  RandomStream random(5, stream);
  MatrixXd result(rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j) result(i, j) = random.normal();
  return result;
}

double spread(const MatrixXd& logs, Index column) {
  const VectorXd values = logs.col(column);
  return std::sqrt((values.array() - values.mean()).square().sum() / static_cast<double>(logs.rows() - 1));
}

/// Uncorrelated, with spreads of 0.1 and 0.3.
MatrixXd members(std::uint64_t stream) {
  MatrixXd logs = normals(20, 2, stream);
  logs.rowwise() -= logs.colwise().mean().eval();
  const MatrixXd basis = logs.householderQr().householderQ() * MatrixXd::Identity(20, 2);
  return std::sqrt(19) * basis * Eigen::Vector2d(0.1, 0.3).asDiagonal();
}

/// Two parameters with spreads of 0.1 and 0.3; predictions are linear in them.
struct Linear {
  MatrixXd logs = members(0);
  MatrixXd sensitivity = normals(400, 2, 1);
  Eigen::Vector2d truth{0.12, -0.2};
  double noise = 0.05;

  Misses misses() const {
    Misses result;
    result.members = sensitivity * logs.transpose();
    result.forecast = result.members.rowwise().mean();
    result.measured = sensitivity * truth + noise * normals(400, 1, 2);
    result.variance = VectorXd::Constant(400, noise * noise);
    return result;
  }
};

/// Mean and covariance of the textbook's Kalman update with the sample's covariance.
TEST(ParameterUpdate, IsTheKalmanUpdateOfALinearModel) {
  const Linear model;
  Misses misses = model.misses();
  misses.variance *= 9;  // no error beyond it is left to be found, and nothing is out of proportion
  const MatrixXd deviations = model.logs.rowwise() - model.logs.colwise().mean();
  const MatrixXd prior = deviations.transpose() * deviations / 19;
  const VectorXd mean = model.logs.colwise().mean();
  const double variance = misses.variance(0);
  const MatrixXd covariance =
      (prior.inverse() + model.sensitivity.transpose() * model.sensitivity / variance).inverse();
  const VectorXd step =
      covariance * model.sensitivity.transpose() * (misses.measured - model.sensitivity * mean) / variance;

  const ParameterUpdate update = update_parameters(model.logs, misses);
  const VectorXd found = update.logs.colwise().mean();
  EXPECT_NEAR((found - mean - step).norm(), 0, 1e-9);
  const MatrixXd after = update.logs.rowwise() - found.transpose();
  EXPECT_NEAR((after.transpose() * after / 19 - covariance).norm(), 0, 1e-9 * prior.norm());
}

TEST(ParameterUpdate, BlocksOfAlikeErrorsCountAsOne) {
  const Linear model;
  Misses misses = model.misses();
  const MatrixXd alone = update_parameters(model.logs, misses).logs;
  misses.places_per_fact = 100;
  const MatrixXd blocks = update_parameters(model.logs, misses).logs;
  EXPECT_NEAR(spread(blocks, 1) / spread(alone, 1), 10, 0.5);
}

/// What the data leave of the misses is the model's error, though the map claims to be exact.
TEST(ParameterUpdate, FindsTheModelsOwnError) {
  const Linear model;
  Misses misses = model.misses();
  const ParameterUpdate stated = update_parameters(model.logs, misses);
  misses.variance.setZero();
  const ParameterUpdate found = update_parameters(model.logs, misses);
  EXPECT_NEAR(spread(found.logs, 0) / spread(stated.logs, 0), 1, 0.15);
  EXPECT_GT(found.innovation, stated.innovation);
}

/// A tenth of the places shows something else that is forty times the noise.
TEST(ParameterUpdate, FootprintsDoLittleHarm) {
  const Linear model;
  Misses misses = model.misses();
  misses.measured.head(40).array() -= 2;
  const VectorXd found = update_parameters(model.logs, misses).logs.colwise().mean();
  EXPECT_NEAR(found(0), model.truth(0), 0.02);
  EXPECT_NEAR(found(1), model.truth(1), 0.02);
}

TEST(ParameterUpdate, WhatTheSurfaceDoesNotShowKeepsItsSpread) {
  Linear model;
  model.sensitivity.col(1).setZero();
  const ParameterUpdate update = update_parameters(model.logs, model.misses());
  EXPECT_LT(spread(update.logs, 0), 0.2 * spread(model.logs, 0));
  EXPECT_NEAR(spread(update.logs, 1) / spread(model.logs, 1), 1, 0.03);
}

/// Members scatter for a reason that has nothing to do with the second parameter: chance correlations of
/// twenty members are not taken for sensitivity, however many places there are.
TEST(ParameterUpdate, ScatterIsNotTakenForSensitivity) {
  double least = 1;
  for (std::uint64_t stream = 10; stream < 40; ++stream) {
    Linear model;
    model.logs = members(stream);
    model.sensitivity.col(1).setZero();
    Misses misses = model.misses();
    misses.members += 0.1 * normals(400, 20, 100 + stream);
    least = std::min(least, spread(update_parameters(model.logs, misses).logs, 1) / spread(model.logs, 1));
  }
  EXPECT_GT(least, 0.9);
}

TEST(ParameterUpdate, WhatIsKnownExactlyStays) {
  Linear model;
  model.logs.col(1).setConstant(0.05);
  const ParameterUpdate update = update_parameters(model.logs, model.misses());
  EXPECT_EQ(update.logs.col(1), model.logs.col(1));
  EXPECT_LT(spread(update.logs, 0), 0.2 * spread(model.logs, 0));
}

TEST(ParameterUpdate, AStillBedSaysNothing) {
  Linear model;
  model.sensitivity.setZero();
  const ParameterUpdate update = update_parameters(model.logs, model.misses());
  EXPECT_EQ(update.information, 0);
  EXPECT_NEAR((update.logs - model.logs).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace aeolian
