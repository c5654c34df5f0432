#include "aeolian_core/slide/surrogate/support_vectors.hpp"

#include <cmath>
#include <memory>

#include <libsvm/svm.h>

#include "aeolian_core/slide/mpm/lane_math.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr std::size_t features = PileFeatures{}.size();

struct Scale {
  double mean = 0;
  double deviation = 1;
};

/// A quantity that does not vary keeps its unit.
template <class Value>
Scale scale_of(std::size_t count, const Value& value) {
  Scale scale;
  for (std::size_t k = 0; k < count; ++k) scale.mean += value(k) / static_cast<double>(count);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += (value(k) - scale.mean) * (value(k) - scale.mean);
  const double deviation = std::sqrt(sum / static_cast<double>(count));
  if (deviation > 1e-12 * std::abs(scale.mean)) scale.deviation = deviation;
  return scale;
}

svm_parameter parameter_of(const SvrSettings& settings) {
  svm_parameter p{};
  p.svm_type = EPSILON_SVR;
  p.kernel_type = settings.kernel == SvrKernel::linear ? LINEAR : RBF;
  p.gamma = settings.gamma;
  p.C = settings.cost;
  p.p = settings.tolerance;
  p.cache_size = 20;
  p.eps = 1e-3;
  p.shrinking = 1;
  return p;
}

void say_nothing(const char*) {}

/// Of vectors that lie feature by feature, `lanes` packs of four.
AEOLIAN_KERNEL double sum_of_bells(const double* columns, const double* weights, std::size_t lanes,
                                   const double* at, double gamma) {
  Lanes sum = constant<Lanes>(0);
  const std::size_t stride = lanes * lane_count;
  for (std::size_t k = 0; k < lanes; ++k) {
    Lanes square = constant<Lanes>(0);
    for (std::size_t d = 0; d < features; ++d) {
      const Lanes apart = load_lanes(columns + d * stride + k * lane_count) - at[d];
      square += apart * apart;
    }
    sum += load_lanes(weights + k * lane_count) * exponential(-gamma * square);
  }
  return sum[0] + sum[1] + (sum[2] + sum[3]);
}

}  // namespace

PileFeatures features_of(const PileQuery& query) {
  return {std::log(query.panel_length), query.panel_height, query.tilt, query.thickness,
          std::log(static_cast<double>(query.event))};
}

SupportVectors SupportVectors::train(const std::vector<PileFeatures>& rows,
                                     const std::vector<double>& targets, const SvrSettings& settings) {
  constexpr Require require{"support vectors"};
  require(!rows.empty() && rows.size() == targets.size(), "number of rows", static_cast<double>(rows.size()),
          "at least 1, and that of targets");
  require(settings.cost > 0, "cost", settings.cost, "positive");
  require(settings.tolerance >= 0, "tolerance", settings.tolerance, "at least 0");
  require(settings.gamma > 0, "gamma", settings.gamma, "positive");
  Parts parts;
  parts.settings = settings;
  for (std::size_t d = 0; d < features; ++d) {
    const Scale scale = scale_of(rows.size(), [&](std::size_t k) { return rows[k][d]; });
    parts.mean[d] = scale.mean;
    parts.deviation[d] = scale.deviation;
  }
  const Scale target = scale_of(rows.size(), [&](std::size_t k) { return targets[k]; });
  parts.target_mean = target.mean;
  parts.target_deviation = target.deviation;

  std::vector<svm_node> nodes(rows.size() * (features + 1));
  std::vector<svm_node*> starts(rows.size());
  std::vector<double> scores(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    starts[k] = &nodes[k * (features + 1)];
    for (std::size_t d = 0; d < features; ++d)
      starts[k][d] = {static_cast<int>(d) + 1, (rows[k][d] - parts.mean[d]) / parts.deviation[d]};
    starts[k][features] = {-1, 0};
    scores[k] = (targets[k] - target.mean) / target.deviation;
  }
  const svm_problem problem{static_cast<int>(rows.size()), scores.data(), starts.data()};
  const svm_parameter parameter = parameter_of(settings);
  static const bool silent = (svm_set_print_string_function(say_nothing), true);
  static_cast<void>(silent);
  const auto drop = [](svm_model* model) { svm_free_and_destroy_model(&model); };
  const std::unique_ptr<svm_model, decltype(drop)> model(svm_train(&problem, &parameter), drop);
  parts.offset = -model->rho[0];
  for (int k = 0; k < model->l; ++k) {
    PileFeatures& vector = parts.vectors.emplace_back();
    for (std::size_t d = 0; d < features; ++d) vector[d] = model->SV[k][d].value;
    parts.weights.push_back(model->sv_coef[0][k]);
  }
  if (settings.kernel == SvrKernel::linear) {
    PileFeatures sum{};
    for (std::size_t k = 0; k < parts.vectors.size(); ++k)
      for (std::size_t d = 0; d < features; ++d) sum[d] += parts.weights[k] * parts.vectors[k][d];
    parts.vectors = {sum};
    parts.weights = {1};
  }
  return SupportVectors(parts);
}

SupportVectors::SupportVectors(const Parts& parts) : parts_(parts) {
  const bool linear = parts.settings.kernel == SvrKernel::linear;
  const std::size_t count = parts.vectors.size();
  if (parts.weights.size() != count || (linear && count != 1))
    throw Error("support vectors: there are " + std::to_string(count) + " vectors and " +
                std::to_string(parts.weights.size()) +
                " weights, must be as many, and one for a linear kernel");
  const std::size_t padded = (count + lane_count - 1) / lane_count * lane_count;
  columns_.assign(padded * features, 0);
  weights_.assign(padded, 0);
  for (std::size_t k = 0; k < count; ++k) {
    weights_[k] = parts.weights[k];
    for (std::size_t d = 0; d < features; ++d) columns_[d * padded + k] = parts.vectors[k][d];
  }
}

double SupportVectors::at(const PileFeatures& point) const {
  PileFeatures z;
  for (std::size_t d = 0; d < features; ++d) z[d] = (point[d] - parts_.mean[d]) / parts_.deviation[d];
  double sum = parts_.offset;
  if (parts_.settings.kernel == SvrKernel::linear)
    for (std::size_t d = 0; d < features; ++d) sum += z[d] * parts_.vectors[0][d];
  else
    sum += sum_of_bells(columns_.data(), weights_.data(), weights_.size() / lane_count, z.data(),
                        parts_.settings.gamma);
  return parts_.target_mean + parts_.target_deviation * sum;
}

}  // namespace aeolian
