#include "aeolian_core/slide/mpm/return_mapping.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

/// One state through the law.
template <int Dim>
struct Outcome {
  Matrix<Dim> b, tau;
  double alpha;
  double p() const { return -tau.trace() / Dim; }
  double q() const {
    const Matrix<Dim> s = tau + p() * Matrix<Dim>::Identity();
    return std::sqrt(1.5) * s.norm();
  }
};

template <int Dim>
Outcome<Dim> flow(const SnowLaw& law, const Matrix<Dim>& b, double alpha) {
  double packed[symmetric_size<Dim>], tau[symmetric_size<Dim>];
  for (int r = 0; r < Dim; ++r)
    for (int c = r; c < Dim; ++c) packed[symmetric_index<Dim>(r, c)] = b(r, c);
  flow_and_stress<Dim, double>(yield_constants(law, Dim), packed, alpha, tau);
  Outcome<Dim> result;
  for (int r = 0; r < Dim; ++r)
    for (int c = 0; c < Dim; ++c) {
      const int k = symmetric_index<Dim>(std::min(r, c), std::max(r, c));
      result.b(r, c) = packed[k];
      result.tau(r, c) = tau[k];
    }
  result.alpha = alpha;
  return result;
}

/// The elastic state in three dimensions whose stress has these invariants.
Matrix<3> state_of(const SnowLaw& law, double p, double q) {
  const double volumetric = -p / law.bulk_modulus(3) / 3;
  const double deviator = q / (std::sqrt(1.5) * 2 * law.shear_modulus());
  const Eigen::Vector3d direction = Eigen::Vector3d(2, -1, -1).normalized();
  const Eigen::Vector3d strain = Eigen::Vector3d::Constant(volumetric) + deviator * direction;
  const Matrix<3> turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d stretches = (2 * strain).array().exp();
  return turn * stretches.asDiagonal() * turn.transpose();
}

// The table of the specification, section 2.6, to 0.1 %.
TEST(ReturnMapping, GoldenTable) {
  SnowLaw law;
  EXPECT_NEAR(law.bulk_modulus(), 833333.33, 0.01);
  EXPECT_NEAR(law.shear_modulus(), 384615.38, 0.01);
  struct Row {
    double p, q, p_after, q_after, expansion, p0_after;
  };
  for (const Row& row :
       {Row{3000, 1000, 3000, 1000, 0, 7000}, Row{3000, 4000, 2972.13, 1773.33, -3.345e-5, 7002.8},
        Row{9000, 500, 6992.49, 106.09, -2.409e-3, 7200.8},
        Row{12000, 6000, 6799.77, 541.47, -6.240e-3, 7520.0},
        Row{-1000, 2000, -598.01, 1043.14, 4.824e-4, 6959.8}, Row{-3000, 0, -1400, 0, 1.920e-3, 6840.0}}) {
    SCOPED_TRACE(row.p);
    const double alpha = law.initial_compaction();
    const Outcome<3> out = flow<3>(law, state_of(law, row.p, row.q), alpha);
    EXPECT_NEAR(out.p(), row.p_after, 1e-3 * std::abs(row.p_after));
    EXPECT_NEAR(out.q(), row.q_after, 1e-3 * row.q_after + 1e-5);
    EXPECT_NEAR(alpha - out.alpha, row.expansion, 1e-3 * std::abs(row.expansion) + 1e-12);
    EXPECT_NEAR(law.consolidation_at(out.alpha), row.p0_after, 1e-3 * row.p0_after);
  }
}

TEST(ReturnMapping, InitialCompactionGivesTheConsolidationAskedFor) {
  SnowLaw law;
  const double expected[] = {0.0240, 0.0480, 0.0600, 0.0720, 0.0840, 0.0960};
  const double pressures[] = {2000, 4000, 5000, 6000, 7000, 8000};
  for (int k = 0; k < 6; ++k) {
    law.consolidation = pressures[k];
    EXPECT_NEAR(law.initial_compaction(), expected[k], 5e-5);
    EXPECT_NEAR(law.consolidation_at(law.initial_compaction()), pressures[k], 1e-6);
  }
}

// A stress that is returned lies on the ellipse, and comes back to itself.
TEST(ReturnMapping, EndsOnTheEllipse) {
  const SnowLaw law;
  const YieldConstants y = yield_constants(law, 3);
  RandomStream random(1, 0);
  for (int k = 0; k < 20000; ++k) {
    const double p0 = 10 * std::exp(8 * random.uniform());
    const Invariants<double> trial{p0 * std::tan(3 * (random.uniform() - 0.5)),
                                   p0 * std::tan(1.5 * random.uniform())};
    const auto value = [&](Invariants<double> s) {
      return ((1 + 2 * law.cohesion) * s.q * s.q +
              law.friction * law.friction * (s.p + law.cohesion * p0) * (s.p - p0)) /
             (p0 * p0);
    };
    const Invariants<double> s = returned_to_ellipse(y, trial, p0);
    if (value(trial) > 0)
      ASSERT_NEAR(value(s), 0, 1e-12) << trial.p << ' ' << trial.q << ' ' << p0;
    else
      ASSERT_TRUE(s.p == trial.p && s.q == trial.q);
  }
}

// Compressed step by step in small strains, snow follows its own p0 (specification, section 5 F).
template <int Dim>
void compress() {
  const SnowLaw law;
  Matrix<Dim> b = Matrix<Dim>::Identity();
  double alpha = law.initial_compaction();
  double compacted = 0;
  for (int k = 0; k < 2000; ++k) {
    const double f = 1 - 1e-4 / Dim;
    compacted -= Dim * std::log(f);
    const Outcome<Dim> out = flow<Dim>(law, f * f * b, alpha);
    b = out.b;
    alpha = out.alpha;
    if (out.p() < 6990) continue;
    ASSERT_NEAR(out.p(), law.consolidation_at(alpha), 2e-3 * out.p());  // p0 is that before the step
  }
  // What is not elastic has gone into alpha.
  EXPECT_NEAR(alpha - law.initial_compaction() - 0.5 * std::log(b.determinant()), compacted, 1e-9);
  EXPECT_GT(alpha, law.initial_compaction() + 0.15);
}
TEST(ReturnMapping, IsotropicCompressionTracesTheConsolidation) {
  compress<2>();
  compress<3>();
}

TEST(ReturnMapping, RotationMakesNoStress) {
  const SnowLaw law;
  Matrix<3> b = Matrix<3>::Identity();
  const Matrix<3> turn = Eigen::AngleAxisd(0.03, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  double alpha = law.initial_compaction();
  for (int k = 0; k < 1000; ++k) {
    const Outcome<3> out = flow<3>(law, turn * b * turn.transpose(), alpha);
    b = out.b;
    alpha = out.alpha;
    ASSERT_LT(std::abs(out.p()) + out.q(), 1e-6);
  }
  EXPECT_DOUBLE_EQ(alpha, law.initial_compaction());
}

/// Any F: of any size, flat, turned inside out, zero.
template <int Dim>
Matrix<Dim> any_deformation(RandomStream& random) {
  Matrix<Dim> f;
  const double size = std::exp(16 * (random.uniform() - 0.5));
  for (int r = 0; r < Dim; ++r)
    for (int c = 0; c < Dim; ++c) f(r, c) = size * random.normal();
  const double kind = random.uniform();
  if (kind < 0.1) f.row(0) = f.row(1);
  if (kind < 0.05) f.col(0).setZero();
  if (kind < 0.01) f.setZero();
  if (kind > 0.9) f = Matrix<Dim>::Identity() + 1e-9 * f;
  if (kind > 0.98) f = Matrix<Dim>::Identity();
  return f;
}

// Four at once and one by one, over a million in all.
template <int Dim>
void survive(SnowLaw::Yield yield, std::uint64_t stream) {
  SnowLaw law;
  law.yield = yield;
  const YieldConstants y = yield_constants(law, Dim);
  RandomStream random(7, stream);
  constexpr int count = symmetric_size<Dim>;
  for (int k = 0; k < 31500; ++k) {
    Lanes b[count], tau[count];
    Lanes alpha = constant<Lanes>(0.1 * random.normal());
    for (int lane = 0; lane < lane_count; ++lane) {
      const Matrix<Dim> f = any_deformation<Dim>(random);
      const Matrix<Dim> left = f * f.transpose();
      for (int r = 0; r < Dim; ++r)
        for (int c = r; c < Dim; ++c) b[symmetric_index<Dim>(r, c)][lane] = left(r, c);
    }
    flow_and_stress<Dim, Lanes>(y, b, alpha, tau);
    for (int lane = 0; lane < lane_count; ++lane) {
      ASSERT_TRUE(std::isfinite(alpha[lane]));
      Matrix<Dim> out;
      for (int r = 0; r < Dim; ++r)
        for (int c = 0; c < Dim; ++c)
          out(r, c) = b[symmetric_index<Dim>(std::min(r, c), std::max(r, c))][lane];
      for (int e = 0; e < count; ++e) ASSERT_TRUE(std::isfinite(b[e][lane]) && std::isfinite(tau[e][lane]));
      ASSERT_GT(out.diagonal().minCoeff(), 0) << out;
    }
  }
}
TEST(ReturnMapping, NoDeformationGivesNoNumber) {
  std::uint64_t stream = 0;
  for (const auto yield : {SnowLaw::Yield::cam_clay, SnowLaw::Yield::drucker_prager, SnowLaw::Yield::none})
    for (int k = 0; k < 2; ++k) {
      survive<2>(yield, stream++);
      survive<3>(yield, stream++);
    }
}

TEST(PrincipalAxes, AgreeWithEigen) {
  RandomStream random(3, 0);
  for (int k = 0; k < 20000; ++k) {
    const Matrix<3> f = any_deformation<3>(random);
    const Matrix<3> b = f * f.transpose();
    const double packed[6] = {b(0, 0), b(1, 1), b(2, 2), b(0, 1), b(0, 2), b(1, 2)};
    double values[3], axes[3][3];
    principal_axes(packed, values, axes);
    Eigen::Vector3d ours(values[0], values[1], values[2]);
    Matrix<3> columns;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) columns(r, c) = axes[r][c];
    ASSERT_LT((columns * ours.asDiagonal() * columns.transpose() - b).norm(), 1e-13 * b.norm() + 1e-300);
    ASSERT_LT((columns.transpose() * columns - Matrix<3>::Identity()).norm(), 1e-13);
    std::sort(ours.data(), ours.data() + 3);
    const Eigen::Vector3d theirs = Eigen::SelfAdjointEigenSolver<Matrix<3>>(b).eigenvalues();
    ASSERT_LT((ours - theirs).norm(), 1e-13 * b.norm() + 1e-300);
  }
}

TEST(LaneMath, LogarithmAndExponential) {
  RandomStream random(4, 0);
  for (int k = 0; k < 50000; ++k) {
    Lanes x;
    for (int lane = 0; lane < lane_count; ++lane) x[lane] = std::exp(60 * (random.uniform() - 0.5));
    if (k % 2) x = 1.0 + 1e-3 * (x / (1.0 + x) - 0.5);
    const Lanes log = natural_log(x);
    const Lanes exp = exponential(log);
    for (int lane = 0; lane < lane_count; ++lane) {
      ASSERT_NEAR(log[lane], std::log(x[lane]), 3e-16 * std::abs(log[lane]));
      ASSERT_NEAR(exp[lane], std::exp(log[lane]), 1e-15 * exp[lane]);
    }
  }
}

// Klar et al. (2016): on the cone q = M p, without dilation; nothing where it is pulled apart.
TEST(ReturnMapping, DruckerPragerCone) {
  SnowLaw law;
  law.yield = SnowLaw::Yield::drucker_prager;
  law.friction = 1.2;
  const Outcome<3> sheared = flow<3>(law, state_of(law, 1000, 5000), 0);
  EXPECT_NEAR(sheared.p(), 1000, 1e-6);
  EXPECT_NEAR(sheared.q(), 1200, 1e-6);
  const Outcome<3> pulled = flow<3>(law, state_of(law, -1000, 500), 0);
  EXPECT_NEAR(pulled.tau.norm(), 0, 1e-9);
  EXPECT_NEAR(pulled.alpha, 1000 / law.bulk_modulus(3), 1e-12);
  // Squeezed by less than it has gained, it does not bear.
  const Outcome<3> squeezed = flow<3>(law, state_of(law, 400, 0), pulled.alpha);
  EXPECT_NEAR(squeezed.tau.norm(), 0, 1e-9);
  EXPECT_NEAR(squeezed.alpha, 600 / law.bulk_modulus(3), 1e-12);
}

}  // namespace
}  // namespace aeolian
