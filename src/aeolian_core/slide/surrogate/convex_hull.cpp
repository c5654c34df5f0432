#include "aeolian_core/slide/surrogate/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double tolerance = 1e-6;  ///< of the hull's extent
constexpr int dimensions = static_cast<int>(PileFeatures{}.size());

/// How far the nearest sum of columns with weights of at least 0 is from `b` (Lawson and Hanson 1974, NNLS).
double distance_to_cone(const Eigen::MatrixXd& columns, const Eigen::VectorXd& b) {
  const auto count = columns.cols();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  std::vector<Eigen::Index> used;
  Eigen::VectorXd residual = b;
  for (Eigen::Index round = 0; round < 10 * count && residual.norm() > tolerance; ++round) {
    Eigen::VectorXd gain = columns.transpose() * residual;
    for (const auto k : used) gain[k] = 0;
    Eigen::Index best = 0;
    if (gain.maxCoeff(&best) <= 1e-12) break;
    used.push_back(best);
    while (!used.empty()) {
      Eigen::MatrixXd part(columns.rows(), static_cast<Eigen::Index>(used.size()));
      for (std::size_t k = 0; k < used.size(); ++k)
        part.col(static_cast<Eigen::Index>(k)) = columns.col(used[k]);
      const Eigen::VectorXd solved = part.colPivHouseholderQr().solve(b);
      if (solved.minCoeff() > 0) {
        for (std::size_t k = 0; k < used.size(); ++k) weights[used[k]] = solved[static_cast<Eigen::Index>(k)];
        break;
      }
      // Goes towards the solution until the first weight is 0, and leaves that one out.
      double step = 1;
      for (std::size_t k = 0; k < used.size(); ++k) {
        const double now = weights[used[k]], then = solved[static_cast<Eigen::Index>(k)];
        if (then <= 0) step = std::min(step, now / std::max(now - then, 1e-300));
      }
      std::vector<Eigen::Index> kept;
      for (std::size_t k = 0; k < used.size(); ++k) {
        double& weight = weights[used[k]];
        const double then = solved[static_cast<Eigen::Index>(k)];
        weight += step * (then - weight);
        if (then <= 0 && weight <= 1e-14)
          weight = 0;
        else
          kept.push_back(used[k]);
      }
      if (kept.size() == used.size()) break;
      used.swap(kept);
    }
    residual = b - columns * weights;
  }
  return residual.norm();
}

}  // namespace

ConvexHull::ConvexHull(const std::vector<PileFeatures>& points) {
  if (points.empty()) throw Error("convex hull: there are 0 points, must be at least 1");
  low_.fill(std::numeric_limits<double>::infinity());
  high_.fill(-std::numeric_limits<double>::infinity());
  for (const PileFeatures& point : points)
    for (std::size_t d = 0; d < point.size(); ++d) {
      if (!std::isfinite(point[d])) throw Error("convex hull: a feature is not finite");
      low_[d] = std::min(low_[d], point[d]);
      high_[d] = std::max(high_[d], point[d]);
    }
  std::vector<PileFeatures> unique = points;
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  const auto put = [&](const std::vector<PileFeatures>& set) {
    columns_.resize(dimensions + 1, static_cast<Eigen::Index>(set.size()));
    for (std::size_t k = 0; k < set.size(); ++k) columns_.col(static_cast<Eigen::Index>(k)) = scaled(set[k]);
  };
  corners_ = unique;
  for (const PileFeatures& point : unique) {
    if (corners_.size() == 1) break;
    std::vector<PileFeatures> others = corners_;
    others.erase(std::find(others.begin(), others.end(), point));
    put(others);
    if (distance_to_cone(columns_, scaled(point)) <= tolerance) corners_.swap(others);
  }
  put(corners_);
  std::size_t ends = 0;
  for (std::size_t mask = 0; mask < (std::size_t{1} << dimensions); ++mask) {
    PileFeatures corner = low_;
    for (std::size_t d = 0; d < corner.size(); ++d)
      if ((mask >> d & 1) != 0) corner[d] = high_[d];
    ends += std::find(corners_.begin(), corners_.end(), corner) != corners_.end() ? 1U : 0U;
  }
  box_ = ends == std::size_t{1} << dimensions;
}

Eigen::VectorXd ConvexHull::scaled(const PileFeatures& point) const {
  Eigen::VectorXd result(dimensions + 1);
  for (std::size_t d = 0; d < point.size(); ++d) {
    const double extent = high_[d] - low_[d];
    result[static_cast<Eigen::Index>(d)] = (point[d] - low_[d]) / (extent > 0 ? extent : 1);
  }
  result[dimensions] = 1;
  return result;
}

bool ConvexHull::within_ranges(const PileFeatures& point) const {
  for (std::size_t d = 0; d < point.size(); ++d) {
    const double extent = high_[d] - low_[d];
    const double slack = tolerance * (extent > 0 ? extent : 1);
    if (!(point[d] >= low_[d] - slack && point[d] <= high_[d] + slack)) return false;
  }
  return true;
}

bool ConvexHull::contains(const PileFeatures& point) const {
  return within_ranges(point) && (box_ || distance_to_cone(columns_, scaled(point)) <= tolerance);
}

}  // namespace aeolian
