#include "aeolian_core/twin/parameter_update.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double outlying = 2.5;       // standard deviations from which on a miss counts by its sign
constexpr double doubtful = 2;         // standard errors within which a sensitivity is none
constexpr int rounds = 10;             // of reweighting
constexpr double least_spread = 1e-9;  // of a logarithm that is not known exactly

constexpr double square(double value) { return value * value; }

/// The logarithms of members as a mean and deviations in units of their spread.
struct Standardised {
  std::vector<Index> active;  ///< columns that are not exactly known
  VectorXd mean, spread;      ///< of the active ones
  MatrixXd deviations;        ///< a row for each member

  explicit Standardised(const MatrixXd& logs) {
    const auto members = static_cast<double>(logs.rows());
    const VectorXd means = logs.colwise().mean();
    const VectorXd spreads =
        ((logs.rowwise() - means.transpose()).colwise().squaredNorm() / (members - 1)).cwiseSqrt();
    for (Index i = 0; i < logs.cols(); ++i)
      if (spreads(i) > least_spread) active.push_back(i);
    const auto count = static_cast<Index>(active.size());
    mean.resize(count);
    spread.resize(count);
    deviations.resize(logs.rows(), count);
    for (Index i = 0; i < count; ++i) {
      const Index column = active[static_cast<std::size_t>(i)];
      mean(i) = means(column);
      spread(i) = spreads(column);
      deviations.col(i) = (logs.col(column).array() - mean(i)) / spread(i);
    }
  }
};

/// How predictions answer to the parameters, and how they scatter besides.
struct Sensitivity {
  MatrixXd of;         ///< a row for each place, a column for each parameter
  double scatter = 0;  ///< variance

  Sensitivity(const MatrixXd& anomalies, const MatrixXd& deviations) {
    const MatrixXd inverse_gram = (deviations.transpose() * deviations).inverse();
    of = anomalies * deviations * inverse_gram;
    const auto places = static_cast<double>(anomalies.rows());
    const auto freedom = static_cast<double>(deviations.rows() - 1 - deviations.cols());
    scatter = (anomalies - of * deviations.transpose()).squaredNorm() / (places * freedom);
    for (Index i = 0; i < of.cols(); ++i) {
      const double found = of.col(i).squaredNorm();
      const double by_chance = square(doubtful) * places * scatter * inverse_gram(i, i);
      of.col(i) *= found > by_chance ? 1 - by_chance / found : 0;
    }
  }
};

double robust_variance(const VectorXd& values) {
  std::vector<double> sizes(static_cast<std::size_t>(values.size()));
  for (Index i = 0; i < values.size(); ++i) sizes[static_cast<std::size_t>(i)] = std::abs(values(i));
  const double sigma = sigma_per_median * median(sizes);
  return sigma * sigma;
}

/// The inverse of each place's error variance, less where the misfit is out of all proportion.
ArrayXd weights(const VectorXd& misfit, const VectorXd& variance, double places_per_fact) {
  const double unexplained = std::max(robust_variance(misfit) - variance.mean(), 0.0);
  constexpr double smallest = 1e-18;  // a perfect model on a perfect map
  const ArrayXd error = (variance.array() + unexplained).max(smallest);
  const ArrayXd sigmas = misfit.array().abs() / error.sqrt();
  return (outlying / sigmas.max(outlying)) / (error * places_per_fact);
}

}  // namespace

ParameterUpdate update_parameters(const MatrixXd& logs, const Misses& misses) {
  const Standardised prior(logs);
  const VectorXd mean = misses.members.rowwise().mean();
  const Sensitivity sensitivity(misses.members.colwise() - mean, prior.deviations);
  const MatrixXd& h = sensitivity.of;
  const VectorXd miss = misses.measured - misses.forecast;

  const MatrixXd covariance =
      prior.deviations.transpose() * prior.deviations / static_cast<double>(logs.rows() - 1);
  const MatrixXd root = covariance.llt().matrixL();
  const MatrixXd precision = covariance.inverse();
  ParameterUpdate result;
  const double expected =
      (h * root).squaredNorm() / static_cast<double>(h.rows()) + sensitivity.scatter + misses.variance.mean();
  const double found = miss.squaredNorm() / static_cast<double>(h.rows());
  result.innovation = found > 0 ? std::sqrt(found / expected) : 0;

  VectorXd step = VectorXd::Zero(h.cols());
  MatrixXd information = MatrixXd::Zero(h.cols(), h.cols());
  for (int round = 0; round < rounds; ++round) {
    const ArrayXd weight = weights(miss - h * step, misses.variance, misses.places_per_fact);
    const MatrixXd weighted = h.array().colwise() * weight;
    information = h.transpose() * weighted;
    step = (precision + information).ldlt().solve(weighted.transpose() * miss);
  }

  // With the prior's covariance L L^T, that of the posterior is L (1 + L^T I L)^-1 L^T.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> gains(root.transpose() * information * root);
  result.information = h.cols() > 0 ? std::max(gains.eigenvalues().maxCoeff(), 0.0) : 0;
  const VectorXd shrinking = (1 + gains.eigenvalues().array().max(0)).rsqrt();
  const MatrixXd transform = root * gains.eigenvectors() * shrinking.asDiagonal() *
                             gains.eigenvectors().transpose() * root.inverse();
  const MatrixXd deviations = prior.deviations * transform.transpose();
  result.logs = logs;
  for (Index i = 0; i < h.cols(); ++i)
    result.logs.col(prior.active[static_cast<std::size_t>(i)]) =
        prior.mean(i) + prior.spread(i) * (step(i) + deviations.col(i).array());
  return result;
}

}  // namespace aeolian
