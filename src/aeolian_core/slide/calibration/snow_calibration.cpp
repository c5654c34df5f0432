#include "aeolian_core/slide/calibration/snow_calibration.hpp"

#include <algorithm>
#include <cmath>

#include <nlopt.hpp>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double first_step = 0.25;  ///< of the optimiser, over each range

/// A number of a set that is searched, on 0 to 1 between the ends of its list.
struct Searched {
  double SnowSet::*number;
  double low, high;
};

std::vector<Searched> searched_of(const SnowGrid& grid) {
  std::vector<Searched> result;
  const auto take = [&](double SnowSet::*number, const std::vector<double>& values) {
    const auto ends = std::minmax_element(values.begin(), values.end());
    if (*ends.second > *ends.first) result.push_back({number, *ends.first, *ends.second});
  };
  take(&SnowSet::friction, grid.friction);
  take(&SnowSet::consolidation, grid.consolidation);
  take(&SnowSet::cohesion, grid.cohesion);
  take(&SnowSet::panel_friction, grid.panel_friction);
  return result;
}

/// What NLopt asks for, and what it has asked.
struct Search {
  const MeasureSets& measure;
  const ErrorScale& scale;
  const std::vector<Searched>& searched;
  SnowSet base;
  std::vector<ScoredSet> tried;

  double operator()(const std::vector<double>& shares) {
    SnowSet set = base;
    for (std::size_t d = 0; d < shares.size(); ++d)
      set.*searched[d].number = searched[d].low + shares[d] * (searched[d].high - searched[d].low);
    const auto errors = measure({set});
    if (!errors) throw nlopt::forced_stop();
    const double score = scale.score(errors->front());
    tried.push_back({set, errors->front(), score});
    return score;
  }
};

/// Nothing when it was stopped.
std::optional<std::vector<ScoredSet>> refine(const SnowGrid& grid, int refinements, const ScoredSet& start,
                                             const ErrorScale& scale, const MeasureSets& measure) {
  const std::vector<Searched> searched = searched_of(grid);
  if (searched.empty() || refinements == 0) return std::vector<ScoredSet>();
  Search search{measure, scale, searched, start.set, {}};
  std::vector<double> shares;
  for (const Searched& s : searched) shares.push_back((start.set.*s.number - s.low) / (s.high - s.low));
  nlopt::opt optimiser(nlopt::LN_SBPLX, static_cast<unsigned>(searched.size()));
  optimiser.set_lower_bounds(0.);
  optimiser.set_upper_bounds(1.);
  optimiser.set_initial_step(first_step);
  optimiser.set_maxeval(refinements);
  optimiser.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                                 void* data) { return (*static_cast<Search*>(data))(x); },
                              &search);
  double score = 0;
  try {
    optimiser.optimize(shares, score);
  } catch (const nlopt::forced_stop&) {
    return std::nullopt;
  } catch (const nlopt::roundoff_limited&) {  // it has found what can be found
  }
  return search.tried;
}

}  // namespace

std::optional<SnowCalibration> calibrate(const SnowGrid& grid, int refinements, const MeasureSets& measure) {
  const std::vector<SnowSet> sets = sets_of(grid);
  const auto errors = measure(sets);
  if (!errors) return std::nullopt;
  const ErrorScale scale(*errors);
  SnowCalibration result;
  for (std::size_t k = 0; k < sets.size(); ++k)
    result.grid.push_back({sets[k], (*errors)[k], scale.score((*errors)[k])});
  const auto less = [](const ScoredSet& a, const ScoredSet& b) { return a.score < b.score; };
  result.best = *std::min_element(result.grid.begin(), result.grid.end(), less);
  auto refined = refine(grid, refinements, result.best, scale, measure);
  if (!refined) return std::nullopt;
  result.refined = std::move(*refined);
  for (const ScoredSet& set : result.refined)
    if (less(set, result.best)) result.best = set;
  return result;
}

double sensitivity_index(double nominal_result, double altered_result, double nominal, double altered) {
  return (altered_result - nominal_result) / nominal_result / ((altered - nominal) / nominal);
}

}  // namespace aeolian
