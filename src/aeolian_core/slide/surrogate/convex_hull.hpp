#pragma once

#include <vector>

#include <Eigen/Core>

#include "aeolian_core/slide/surrogate/support_vectors.hpp"

namespace aeolian {

/// The convex hull of the features that were learnt from: between them a surrogate knows, outside it guesses.
class ConvexHull {
 public:
  /// Keeps those of the points that are its corners. Throws Error when there are none or not all are finite.
  explicit ConvexHull(const std::vector<PileFeatures>& points);

  /// To a millionth of its extent. A feature that is the same for all must be that.
  bool contains(const PileFeatures& point) const;
  const std::vector<PileFeatures>& corners() const { return corners_; }
  const PileFeatures& low() const { return low_; }
  const PileFeatures& high() const { return high_; }

 private:
  bool within_ranges(const PileFeatures& point) const;
  Eigen::VectorXd scaled(const PileFeatures& point) const;

  std::vector<PileFeatures> corners_;
  PileFeatures low_{}, high_{};
  Eigen::MatrixXd columns_;  ///< scaled corners, and a row of ones
  bool box_ = false;         ///< it is all of its ranges: nothing to solve
};

}  // namespace aeolian
