#pragma once

#include <array>
#include <vector>

#include "aeolian_core/slide/surrogate/pile_table.hpp"

namespace aeolian {

/// What a pile is learnt from: ln of the panel's length, its height, tilt, the slab's thickness, ln of the
/// event. Piles grow like the logarithm of events and of short panels (specification, 5 B and D).
using PileFeatures = std::array<double, 5>;
PileFeatures features_of(const PileQuery& query);

enum class SvrKernel {
  linear,  ///< x . x'
  rbf      ///< exp(-gamma |x - x'|^2)
};

/// Of an epsilon-support-vector regression, all for z-scores.
struct SvrSettings {
  SvrKernel kernel = SvrKernel::rbf;
  double cost = 10;        ///< C: how dear an error is
  double tolerance = 0.1;  ///< epsilon: errors below it are free
  double gamma = 0.1;      ///< of the RBF
};

/// A trained regression (specification, 2.11): f(x) = sum of a_k K(x_k, x) + b of z-scores.
class SupportVectors {
 public:
  /// What decides it, to be written and read.
  struct Parts {
    SvrSettings settings;
    PileFeatures mean{}, deviation{};              ///< of the features
    double target_mean = 0, target_deviation = 1;  ///< of what is learnt
    double offset = 0;                             ///< b
    std::vector<PileFeatures> vectors;             ///< z-scores; of a linear kernel one: their weighted sum
    std::vector<double> weights;                   ///< a_k; of a linear kernel 1
  };

  /// Trains by libsvm. Throws Error when there are no rows or settings are not positive.
  static SupportVectors train(const std::vector<PileFeatures>& rows, const std::vector<double>& targets,
                              const SvrSettings& settings);
  /// Throws Error when the parts do not fit each other.
  explicit SupportVectors(const Parts& parts);

  double at(const PileFeatures& features) const;
  const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
  std::vector<double> columns_;  ///< vectors by feature, each filled up to whole lanes
  std::vector<double> weights_;
};

}  // namespace aeolian
