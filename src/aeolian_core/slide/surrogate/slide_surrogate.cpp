#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

double height_of(const PileRecord& r) { return r.height; }
double length_of(const PileRecord& r) { return r.length; }
double shape_of(const PileRecord& r) { return r.shape(); }

/// The smallest that so many of the next are below: the quantile of n residuals and one more at infinity.
double conformal_quantile(std::vector<double> residuals, double coverage) {
  const auto n = static_cast<double>(residuals.size());
  const double rank = std::ceil(coverage * (n + 1));
  Require{"surrogate"}(rank <= n, "number of piles", n, "enough for the coverage");
  const auto place = residuals.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(residuals.begin(), place, residuals.end());
  return *place;
}

SlideSurrogate::Target learnt(const TrainingRows& rows, const SlideSurrogate::Settings& settings) {
  const std::vector<int> folds = grouped_folds(rows.runs, settings.folds, settings.seed);
  const SvrSettings best = best_settings(rows, folds, settings.kernel, settings.grid);
  std::vector<double> residuals = out_of_fold(rows, folds, best);
  for (std::size_t k = 0; k < residuals.size(); ++k) residuals[k] = std::abs(residuals[k] - rows.targets[k]);
  return {SupportVectors::train(rows.features, rows.targets, best),
          conformal_quantile(residuals, settings.coverage)};
}

Estimate estimate(const SlideSurrogate::Target& target, const PileFeatures& features) {
  const double value = std::exp(target.vectors.at(features));
  const double factor = std::exp(target.half_width);
  return {value, value / factor, value * factor};
}

}  // namespace

TrainingRows rows_of(const PileTable& table, double (*number)(const PileRecord&)) {
  TrainingRows rows;
  for (const PileRecord& record : table) {
    rows.features.push_back(features_of(record.query));
    rows.targets.push_back(std::log(number(record)));
    rows.runs.push_back(record.run);
  }
  return rows;
}

SlideSurrogate::SlideSurrogate(Target height, Target length, Target shape, ConvexHull hull, double coverage)
    : height_(std::move(height)),
      length_(std::move(length)),
      shape_(std::move(shape)),
      hull_(std::move(hull)),
      coverage_(coverage) {}

SlideSurrogate SlideSurrogate::train(const PileTable& table, const Settings& settings) {
  if (table.empty()) throw Error("surrogate: there are 0 piles, must be at least 1");
  Require{"surrogate"}(settings.coverage > 0 && settings.coverage < 1, "coverage", settings.coverage,
                       "between 0 and 1");
  const TrainingRows rows = rows_of(table, height_of);
  return {learnt(rows, settings), learnt(rows_of(table, length_of), settings),
          learnt(rows_of(table, shape_of), settings), ConvexHull(rows.features), settings.coverage};
}

std::optional<PilePrediction> SlideSurrogate::predict(const PileQuery& query) const {
  if (!hull_.contains(features_of(query))) return std::nullopt;
  return predict_anywhere(query);
}

PilePrediction SlideSurrogate::predict_anywhere(const PileQuery& query) const {
  const PileFeatures features = features_of(query);
  return {estimate(height_, features), estimate(length_, features), estimate(shape_, features)};
}

std::string SlideSurrogate::why_outside(const PileQuery& query) const {
  const PileFeatures at = features_of(query), &low = hull_.low(), &high = hull_.high();
  struct Axis {
    const char* name;
    const char* unit;
    double (*shown)(double);
  };
  const auto as_is = [](double v) { return v; };
  const auto unlogged = [](double v) { return std::exp(v); };
  const auto in_degrees = [](double v) { return v / degree; };
  const Axis axes[] = {{"panel length", " m", unlogged},
                       {"panel height", " m", as_is},
                       {"tilt", " degrees", in_degrees},
                       {"thickness", " m", as_is},
                       {"event", "", unlogged}};
  for (std::size_t d = 0; d < at.size(); ++d) {
    const double slack = 1e-6 * (high[d] - low[d]);
    if (at[d] >= low[d] - slack && at[d] <= high[d] + slack) continue;
    const Axis& a = axes[d];
    return fmt::format("{} is {:.4g}{}, the table has {:.4g} to {:.4g}{}", a.name, a.shown(at[d]), a.unit,
                       a.shown(low[d]), a.shown(high[d]), a.unit);
  }
  return "no mean of the table's panels is like this one";
}

}  // namespace aeolian
