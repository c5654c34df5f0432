#include "aeolian_core/saltation/mixing.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// x = a x + b, by hand.
struct LinearProblem {
  Eigen::Matrix3d a;
  Eigen::Vector3d b;

  LinearProblem() : b(1, 2, 3) { a << 0.9, 0.2, 0, -0.3, 0.5, 0.1, 0, 0.4, 0.7; }
  Eigen::VectorXd result(const Eigen::VectorXd& x) const { return a * x + b; }
  Eigen::Vector3d solution() const { return (Eigen::Matrix3d::Identity() - a).inverse() * b; }
};

Eigen::VectorXd after(int steps, const LinearProblem& problem, Eigen::VectorXd x, AndersonMixing& mixing) {
  for (int n = 0; n < steps; ++n) x = mixing.next(x, problem.result(x), Eigen::Vector3d(1, 2, 0.5));
  return x;
}

TEST(AndersonMixingTest, solves_a_linear_problem_in_one_step_more_than_it_has_unknowns) {
  const LinearProblem problem;
  AndersonMixing mixing(5);
  const Eigen::VectorXd x = after(4, problem, Eigen::Vector3d::Zero(), mixing);
  EXPECT_LT((x - problem.solution()).norm(), 1e-6 * problem.solution().norm());
}

TEST(AndersonMixingTest, what_changes_did_solves_the_next_problem_at_once) {
  LinearProblem problem;
  AndersonMixing mixing(5);
  const Eigen::VectorXd x = after(4, problem, Eigen::Vector3d::Zero(), mixing);
  problem.b = Eigen::Vector3d(-2, 5, 1);
  mixing.begin_anew();
  EXPECT_LT((after(1, problem, x, mixing) - problem.solution()).norm(), 1e-6 * problem.solution().norm());
}

TEST(AndersonMixingTest, without_memory_it_repeats) {
  const LinearProblem problem;
  AndersonMixing mixing(0);
  const Eigen::VectorXd x = Eigen::Vector3d(3, 2, 1);
  EXPECT_EQ(after(1, problem, x, mixing), problem.result(x));
  EXPECT_EQ(after(1, problem, problem.result(x), mixing), problem.result(problem.result(x)));
}

}  // namespace
}  // namespace aeolian
