#pragma once

#include "aeolian_core/slide/mpm/lane_math.hpp"

namespace aeolian {

/// Symmetric matrices are stored by their diagonal, then xy, xz, yz.
template <int Dim>
constexpr int symmetric_size = Dim*(Dim + 1) / 2;

template <int Dim>
constexpr int symmetric_index(int row, int column) {
  return row == column ? row : row + column + Dim - 1;
}

/// One rotation of Jacobi's method: makes the element (p, q) of the symmetric matrix `a` zero, and turns the
/// columns p, q of `axes`. r is the third index.
template <class Real>
AEOLIAN_INLINE void turn_to_axes(Real& app, Real& aqq, Real& apq, Real& apr, Real& aqr, Real axes[3][3],
                                 int p, int q) {
  // tan of the angle: the smaller root of t^2 + 2 theta t - 1 = 0, written without a division by apq.
  const Real difference = aqq - app;
  const Real twice = 2.0 * apq;
  const Real root = square_root(difference * difference + twice * twice);
  const Real denominator = size_of(difference) + root;
  const Real signed_twice = difference < 0.0 ? -twice : twice;
  const Real tangent = denominator > 0.0
                           ? signed_twice / (denominator > 0.0 ? denominator : constant<Real>(1))
                           : constant<Real>(0);
  const Real cosine = 1.0 / square_root(tangent * tangent + 1.0);
  const Real sine = tangent * cosine;
  app -= tangent * apq;
  aqq += tangent * apq;
  apq = constant<Real>(0);
  const Real pr = apr;
  apr = cosine * pr - sine * aqr;
  aqr = sine * pr + cosine * aqr;
  for (int row = 0; row < 3; ++row) {
    const Real old = axes[row][p];
    axes[row][p] = cosine * old - sine * axes[row][q];
    axes[row][q] = sine * old + cosine * axes[row][q];
  }
}

/// Eigenvalues of a symmetric 3 x 3 matrix and its unit eigenvectors, the columns of `axes`, by Jacobi's
/// cyclic method. Degenerate and zero matrices are as good as any.
template <class Real>
AEOLIAN_INLINE void principal_axes(const Real matrix[6], Real values[3], Real axes[3][3]) {
  Real a[6];
  for (int k = 0; k < 6; ++k) a[k] = matrix[k];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) axes[row][column] = constant<Real>(row == column ? 1 : 0);
  constexpr int sweeps_most = 12;  // it takes four or five
  for (int sweep = 0; sweep < sweeps_most; ++sweep) {
    const Real off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
    const Real on = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    if (!any(off > 1e-32 * on)) break;
    turn_to_axes(a[0], a[1], a[3], a[4], a[5], axes, 0, 1);
    turn_to_axes(a[0], a[2], a[4], a[3], a[5], axes, 0, 2);
    turn_to_axes(a[1], a[2], a[5], a[3], a[4], axes, 1, 2);
  }
  for (int k = 0; k < 3; ++k) values[k] = a[k];
}

/// What a function of a symmetric matrix needs of it: eigenvalues, and how to build a matrix of the same
/// axes.
template <int Dim, class Real>
class Spectrum;

/// In two dimensions every function of b is m I + d N, with N = (b - mean I) / radius.
template <class Real>
class Spectrum<2, Real> {
 public:
  AEOLIAN_INLINE explicit Spectrum(const Real b[3]) {
    const Real mean = 0.5 * (b[0] + b[1]);
    const Real half = 0.5 * (b[0] - b[1]);
    const Real radius = square_root(half * half + b[2] * b[2]);
    const Real scale = radius > 0.0 ? 1.0 / (radius > 0.0 ? radius : constant<Real>(1)) : constant<Real>(0);
    along_ = half * scale;
    across_ = b[2] * scale;
    values[0] = mean + radius;
    values[1] = mean - radius;
  }
  AEOLIAN_INLINE void compose(const Real principal[2], Real result[3]) const {
    const Real mean = 0.5 * (principal[0] + principal[1]);
    const Real half = 0.5 * (principal[0] - principal[1]);
    result[0] = mean + half * along_;
    result[1] = mean - half * along_;
    result[2] = half * across_;
  }

  Real values[2];

 private:
  Real along_, across_;
};

template <class Real>
class Spectrum<3, Real> {
 public:
  AEOLIAN_INLINE explicit Spectrum(const Real b[6]) { principal_axes(b, values, axes_); }
  AEOLIAN_INLINE void compose(const Real principal[3], Real result[6]) const {
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column) {
        Real sum = constant<Real>(0);
        for (int k = 0; k < 3; ++k) sum += principal[k] * axes_[row][k] * axes_[column][k];
        result[symmetric_index<3>(row, column)] = sum;
      }
  }

  Real values[3];

 private:
  Real axes_[3][3];
};

}  // namespace aeolian
