#pragma once

#include <array>

namespace aeolian {

/// The impact angles of grains on a bed: one, or a few that stand for a distribution. Linear theory and the
/// longest stable step know them by the mean of their cotangents only.
class ImpactAngles {
 public:
  static constexpr int most = 3;

  /// One angle, by its tangent.
  ImpactAngles(double tangent) : count_(1), tangent_{tangent} {}  // NOLINT: a number is an angle
  /// A log-normal distribution of this mean and standard deviation [rad] by the three nodes of Gauss-Hermite
  /// quadrature, held within `shallowest` and `steepest`; one angle without deviation.
  ImpactAngles(double mean, double deviation);

  static constexpr double shallowest = 0.02;  ///< [rad]
  static constexpr double steepest = 1.4;

  int count() const { return count_; }
  double tangent(int i) const { return tangent_[static_cast<std::size_t>(i)]; }
  double least_tangent() const;
  /// Share of the impacts on a flat bed.
  double weight(int i) const { return count_ == 1 ? 1 : i == 0 ? 2.0 / 3 : 1.0 / 6; }
  /// Tangent of the one angle that has the mean cotangent.
  double effective_tangent() const;

 private:
  int count_;
  std::array<double, most> tangent_;
};

}  // namespace aeolian
