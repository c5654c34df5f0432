#include "aeolian_core/saltation/mixing.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/QR>

namespace aeolian {
namespace {

constexpr double parallel = 1e-4;  ///< sine of the angle between changes that tell the same

}  // namespace

Eigen::VectorXd AndersonMixing::next(const Eigen::VectorXd& x, const Eigen::VectorXd& g,
                                     const Eigen::VectorXd& weight) {
  Point now{g, weight.cwiseProduct(g - x)};
  if (last_) changes_.push_back({now.result - last_->result, now.residual - last_->residual});
  if (changes_.size() > static_cast<std::size_t>(memory_)) changes_.erase(changes_.begin());
  last_ = std::move(now);
  if (changes_.empty()) return g;
  const auto columns = static_cast<Eigen::Index>(changes_.size());
  Eigen::MatrixXd change(x.size(), columns);
  Eigen::VectorXd inverse_norm(columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    const Eigen::VectorXd& residual = changes_[static_cast<std::size_t>(i)].residual;
    inverse_norm[i] = 1 / std::max(residual.norm(), std::numeric_limits<double>::min());
    change.col(i) = inverse_norm[i] * residual;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(parallel);
  qr.compute(change);
  const Eigen::VectorXd part = inverse_norm.cwiseProduct(Eigen::VectorXd(qr.solve(last_->residual)));
  Eigen::VectorXd mixed = g;
  for (std::size_t i = 0; i < changes_.size(); ++i)
    mixed -= part[static_cast<Eigen::Index>(i)] * changes_[i].result;
  return mixed;
}

}  // namespace aeolian
