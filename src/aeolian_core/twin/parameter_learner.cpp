#include "aeolian_core/twin/parameter_learner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/twin/parameter_update.hpp"

namespace aeolian {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Require require{"learning"};
constexpr std::size_t fewest_members = UncertainParameters::count + 3;
constexpr double fewest_blocks = 4;         // of known cells
constexpr double least_information = 1e-3;  // a spread that shrinks by less than a thousandth stays as it is

MatrixXd logs_of(const std::vector<UncertainParameters>& members) {
  MatrixXd logs(members.size(), UncertainParameters::count);
  for (Index i = 0; i < logs.rows(); ++i) {
    const auto values = members[static_cast<std::size_t>(i)].values();
    for (Index j = 0; j < logs.cols(); ++j) logs(i, j) = std::log(values[static_cast<std::size_t>(j)]);
  }
  return logs;
}

std::vector<UncertainParameters> within_bounds(const MatrixXd& logs, const ParameterPriors& priors) {
  std::vector<UncertainParameters> members;
  for (Index i = 0; i < logs.rows(); ++i) {
    std::array<double, UncertainParameters::count> values{};
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] = std::clamp(std::exp(logs(i, static_cast<Index>(j))), priors[j].low, priors[j].high);
    members.push_back(UncertainParameters::from(values));
  }
  return members;
}

/// Draws without what chance leaves in a small sample: means, spreads and correlations are the priors'.
MatrixXd balanced(MatrixXd logs, const ParameterPriors& priors) {
  std::vector<Index> uncertain;
  for (std::size_t j = 0; j < priors.size(); ++j)
    if (priors[j].sigma > 0) uncertain.push_back(static_cast<Index>(j));
  MatrixXd some(logs.rows(), static_cast<Index>(uncertain.size()));
  for (std::size_t j = 0; j < uncertain.size(); ++j) some.col(static_cast<Index>(j)) = logs.col(uncertain[j]);
  some.rowwise() -= some.colwise().mean().eval();
  const MatrixXd covariance = some.transpose() * some / static_cast<double>(logs.rows() - 1);
  const MatrixXd root = covariance.llt().matrixU();
  some = root.transpose().triangularView<Eigen::Lower>().solve(some.transpose()).transpose().eval();
  for (std::size_t j = 0; j < uncertain.size(); ++j) {
    const ParameterPrior& prior = priors[static_cast<std::size_t>(uncertain[j])];
    logs.col(uncertain[j]) = std::log(prior.median) + prior.sigma * some.col(static_cast<Index>(j)).array();
  }
  return logs;
}

/// Members about their mean so that no spread is less than its share of the prior's.
void inflate(MatrixXd& logs, const ParameterPriors& priors, double least_share) {
  for (std::size_t j = 0; j < priors.size(); ++j) {
    auto column = logs.col(static_cast<Index>(j));
    const double mean = column.mean();
    const double spread =
        std::sqrt((column.array() - mean).square().sum() / static_cast<double>(logs.rows() - 1));
    const double least = least_share * priors[j].sigma;
    if (spread > 0 && spread < least) column = mean + (column.array() - mean) * (least / spread);
  }
}

/// On the cells over which misses are averaged, whole ones only.
GridGeometry averaging_grid(const GridGeometry& members, double cell) {
  const int factor = std::max(1, static_cast<int>(std::floor(cell / members.cell() * (1 + 1e-9))));
  return {members.origin_x(), members.origin_y(), factor * members.cell(), std::max(1, members.nx() / factor),
          std::max(1, members.ny() / factor)};
}

HeightMap::Layer on(const GridGeometry& grid, const GridGeometry& own, const HeightMap::Layer& values) {
  HeightMap map(own);
  map.add(layer::elevation, values);
  return own == grid ? values : resample(map, grid).layer(layer::elevation);
}

/// The misses where measurement and members are known.
Misses misses_of(const EnsembleForecast& predicted, std::size_t horizon, const HeightMap& measured,
                 const ParameterLearner::Settings& settings) {
  const GridGeometry grid = averaging_grid(predicted.member_geometry, settings.cell);
  const HeightMap::Layer found = on(grid, measured.geometry(), measured.layer(layer::elevation));
  const HeightMap::Layer variance = measured.has(layer::variance)
                                        ? on(grid, measured.geometry(), measured.layer(layer::variance))
                                        : HeightMap::Layer(grid.size(), 0.0F);
  std::vector<HeightMap::Layer> members;
  for (const MemberForecast& member : predicted.members)
    members.push_back(on(grid, predicted.member_geometry, member.elevation[horizon]));
  const HeightMap& map = predicted.forecasts[horizon].map;
  const HeightMap::Layer forecast = on(grid, map.geometry(), map.layer(layer::elevation));
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (std::isfinite(found[i]) && std::isfinite(forecast[i]) &&
        std::all_of(members.begin(), members.end(),
                    [i](const HeightMap::Layer& m) { return std::isfinite(m[i]); }))
      known.push_back(i);

  Misses misses;
  const auto places = static_cast<Index>(known.size());
  misses.places_per_fact = std::max(1.0, std::pow(settings.block / grid.cell(), 2));
  misses.members.resize(places, static_cast<Index>(members.size()));
  misses.forecast.resize(places);
  misses.measured.resize(places);
  misses.variance.resize(places);
  for (Index row = 0; row < places; ++row) {
    const std::size_t i = known[static_cast<std::size_t>(row)];
    misses.measured(row) = found[i];
    misses.forecast(row) = forecast[i];
    misses.variance(row) = std::isfinite(variance[i]) ? std::max(0.0F, variance[i]) : 0;
    for (std::size_t m = 0; m < members.size(); ++m)
      misses.members(row, static_cast<Index>(m)) = members[m][i];
  }
  return misses;
}

bool made_by(const EnsembleForecast& predicted, const std::vector<UncertainParameters>& members) {
  return std::equal(predicted.members.begin(), predicted.members.end(), members.begin(), members.end(),
                    [](const MemberForecast& forecast, const UncertainParameters& member) {
                      return forecast.parameters.values() == member.values();
                    });
}

}  // namespace

ParameterLearner::ParameterLearner(const Settings& settings) : settings_(settings) {
  require(settings.members >= fewest_members && settings.members <= 10000, "members",
          static_cast<double>(settings.members), "8 to 10000");
  require(settings.cell >= 0 && std::isfinite(settings.cell), "cell", settings.cell,
          "zero or more and finite");
  require(settings.block > 0 && std::isfinite(settings.block), "block", settings.block,
          "positive and finite");
  require(settings.least_spread >= 0 && settings.least_spread <= 1, "least_spread", settings.least_spread,
          "0 to 1");
  const MatrixXd logs = logs_of(draw_parameters(settings.priors, settings.members, settings.seed));
  state_.members = within_bounds(balanced(logs, settings.priors), settings.priors);
}

UncertainParameters ParameterLearner::median() const {
  const Eigen::VectorXd mean = logs_of(state_.members).colwise().mean();
  std::array<double, UncertainParameters::count> values{};
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = std::exp(mean(static_cast<Index>(j)));
  return UncertainParameters::from(values);
}

ParameterLearner::Update ParameterLearner::learn(const EnsembleForecast& predicted, std::size_t horizon,
                                                 const HeightMap& measured) {
  if (horizon >= predicted.forecasts.size())
    throw Error("learning: there is no horizon " + std::to_string(horizon) + ", the forecast has " +
                std::to_string(predicted.forecasts.size()));
  Update update;
  update.before = update.after = median();
  const auto nothing = [&update](const std::string& why) {
    update.why_not = why;
    return update;
  };
  if (!made_by(predicted, state_.members)) return nothing("the forecast was made with other parameters");
  const Misses misses = misses_of(predicted, horizon, measured, settings_);
  if (static_cast<double>(misses.measured.size()) < fewest_blocks * misses.places_per_fact)
    return nothing("too few cells are known in forecast and measurement");

  const ParameterUpdate found = update_parameters(logs_of(state_.members), misses);
  update.innovation = found.innovation;
  if (settings_.frozen) return nothing("frozen");
  if (!(found.information > least_information)) return nothing("the surface does not tell of the parameters");
  MatrixXd logs = found.logs;
  inflate(logs, settings_.priors, settings_.least_spread);
  state_.members = within_bounds(logs, settings_.priors);
  ++state_.updates;
  update.learned = true;
  update.after = median();
  return update;
}

}  // namespace aeolian
