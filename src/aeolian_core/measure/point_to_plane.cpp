#include "aeolian_core/measure/point_to_plane.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "aeolian_core/measure/biweights.hpp"

namespace aeolian {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double signal_to_noise = 2;  // of slopes that hold

std::vector<double> weights_of(const std::vector<PointOnPlane>& pairs, double farthest) {
  std::vector<double> distances;
  distances.reserve(pairs.size());
  for (const PointOnPlane& pair : pairs) distances.push_back(pair.residual);
  return biweights(std::move(distances), farthest);
}

Vector6 row(const PointOnPlane& pair, double arm) {
  Vector6 result;
  result << pair.normal, pair.point.cross(pair.normal) / arm;
  return result;
}

Eigen::Isometry3d move_of(const Vector6& twist, double arm) {
  const Eigen::Vector3d turn = twist.tail<3>() / arm;
  const double angle = turn.norm();
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  if (angle > 0) move.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  move.translation() = twist.head<3>();
  return move;
}

}  // namespace

HeldDirections held_directions(const std::vector<PointOnPlane>& pairs, double farthest, double least_slope) {
  HeldDirections held;
  double squares = 0;
  for (const PointOnPlane& pair : pairs) squares += pair.point.squaredNorm();
  if (squares > 0) held.arm = std::sqrt(squares / static_cast<double>(pairs.size()));

  Matrix6 normal_matrix = Matrix6::Zero();
  Matrix6 noise = Matrix6::Zero();
  double total = 0;
  const std::vector<double> weights = weights_of(pairs, farthest);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PointOnPlane& pair = pairs[i];
    const Vector6 full = row(pair, held.arm);
    normal_matrix += weights[i] * full * full.transpose();
    total += weights[i];
    const Eigen::Vector3d side = pair.normal.unitOrthogonal();
    for (const Eigen::Vector3d& error : {side, Eigen::Vector3d(pair.normal.cross(side))}) {
      const Vector6 feigned = row({pair.point, error, 0, 0}, held.arm);
      noise += weights[i] * pair.normal_variance * feigned * feigned.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(normal_matrix / std::max(total, 1e-300));
  std::vector<Vector6> columns;
  for (int i = 5; i >= 0; --i) {
    const Vector6 direction = solver.eigenvectors().col(i);
    const double feigned = direction.dot(noise * direction) / std::max(total, 1e-300);
    const double least = std::max(least_slope * least_slope, signal_to_noise * signal_to_noise * feigned);
    if (solver.eigenvalues()[i] > least) columns.push_back(direction);
  }
  held.basis.resize(6, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) held.basis.col(static_cast<Eigen::Index>(i)) = columns[i];
  return held;
}

Eigen::Isometry3d step_to_planes(const std::vector<PointOnPlane>& pairs, double farthest,
                                 const HeldDirections& held) {
  Matrix6 normal_matrix = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  const std::vector<double> weights = weights_of(pairs, farthest);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Vector6 full = row(pairs[i], held.arm);
    normal_matrix += weights[i] * full * full.transpose();
    right -= weights[i] * pairs[i].residual * full;
  }
  const Eigen::MatrixXd reduced = held.basis.transpose() * normal_matrix * held.basis;
  const Eigen::VectorXd solution = reduced.ldlt().solve(held.basis.transpose() * right);
  return move_of(held.basis * solution, held.arm);
}

Eigen::Isometry3d held_part(const Eigen::Isometry3d& move, const HeldDirections& held) {
  const Eigen::AngleAxisd turn(move.rotation());
  Vector6 twist;
  twist << move.translation(), turn.angle() * held.arm * turn.axis();
  return move_of(held.basis * (held.basis.transpose() * twist), held.arm);
}

}  // namespace aeolian
