#include "aeolian_core/saltation/mixing.hpp"

#include <Eigen/QR>

namespace aeolian {

Eigen::VectorXd AndersonMixing::next(const Eigen::VectorXd& x, const Eigen::VectorXd& g,
                                     const Eigen::VectorXd& weight) {
  results_.push_back(g);
  residuals_.push_back(weight.cwiseProduct(g - x));
  if (results_.size() > static_cast<std::size_t>(memory_) + 1) {
    results_.erase(results_.begin());
    residuals_.erase(residuals_.begin());
  }
  const auto differences = static_cast<Eigen::Index>(results_.size()) - 1;
  if (differences == 0) return g;
  Eigen::MatrixXd change(x.size(), differences);
  for (Eigen::Index i = 0; i < differences; ++i)
    change.col(i) = residuals_.back() - residuals_[static_cast<std::size_t>(i)];
  // Normal equations, a little towards zero where differences are nearly parallel.
  Eigen::MatrixXd normal = change.transpose() * change;
  normal.diagonal() *= 1 + 1e-8;
  const Eigen::VectorXd part = normal.colPivHouseholderQr().solve(change.transpose() * residuals_.back());
  Eigen::VectorXd mixed = g;
  for (Eigen::Index i = 0; i < differences; ++i)
    mixed -= part[i] * (g - results_[static_cast<std::size_t>(i)]);
  return mixed;
}

void AndersonMixing::forget() {
  if (results_.empty()) return;
  results_.erase(results_.begin(), results_.end() - 1);
  residuals_.erase(residuals_.begin(), residuals_.end() - 1);
}

}  // namespace aeolian
