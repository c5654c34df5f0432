#pragma once

#include "aeolian_core/wind/sph/neighbours.hpp"

namespace aeolian::sph {

/// Solves sum_j weight_ij (p_j - p_i) = source_i for the pressure, by conjugate gradients scaled by the
/// diagonal. No air leaves through a wall, as the pressure of an image is that of its particle; only
/// differences of pressure matter, its mean is kept at zero.
class PressureSolver {
 public:
  struct Limits {
    float residual = 0;  ///< root mean square of what is left of the equation
    int iterations = 100;
  };
  /// `pressure` is where it starts and what it gives. Gives the residual that is left.
  float solve(const NeighbourRows& rows, const std::vector<float>& diagonal, const std::vector<float>& source,
              const Limits& limits, std::vector<float>& pressure);
  int iterations() const { return iterations_; }

 private:
  std::vector<float> residual_, direction_, product_;
  std::vector<double> sums_, more_sums_;
  int iterations_ = 0;
};

}  // namespace aeolian::sph
