#include "aeolian_core/twin/uncertain_parameters.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(UncertainParameters, NamesStandBesideTheirValues) {
  const UncertainParameters parameters{1, 2, 3, 4, 5};
  EXPECT_EQ(parameters.values(), (std::array<double, 5>{1, 2, 3, 4, 5}));
  EXPECT_EQ(UncertainParameters::from(parameters.values()).values(), parameters.values());
  EXPECT_EQ(UncertainParameters::names()[1], "reptation_length");
}

TEST(UncertainParameters, DrawsHaveTheirPriorsMedianAndSpread) {
  const ParameterPriors priors = default_priors();
  const auto members = draw_parameters(priors, 4000, 3);
  for (std::size_t i = 0; i < priors.size(); ++i) {
    double sum = 0;
    double square = 0;
    for (const auto& member : members) {
      const double off = std::log(member.values()[i] / priors[i].median);
      sum += off / 4000;
      square += off * off / 4000;
    }
    EXPECT_NEAR(sum, 0, 4 * priors[i].sigma / std::sqrt(4000)) << UncertainParameters::names()[i];
    EXPECT_NEAR(std::sqrt(square), priors[i].sigma, 0.05 * priors[i].sigma);
  }
}

TEST(UncertainParameters, AMemberDoesNotDependOnHowManyThereAre) {
  const auto few = draw_parameters(default_priors(), 3, 7);
  const auto many = draw_parameters(default_priors(), 30, 7);
  const auto others = draw_parameters(default_priors(), 3, 8);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(few[i].values(), many[i].values());
    EXPECT_NE(few[i].values(), others[i].values());
  }
}

TEST(UncertainParameters, BoundsHoldAndWhatIsKnownIsKept) {
  ParameterPriors priors = default_priors();
  priors[0] = {1, 1.5, 0.9, 1.1};
  priors[1] = {1.3, 0, 0.5, 2};
  for (const auto& member : draw_parameters(priors, 100, 1)) {
    EXPECT_GE(member.friction_velocity, 0.9);
    EXPECT_LE(member.friction_velocity, 1.1);
    EXPECT_EQ(member.reptation_length, 1.3);
  }
}

TEST(UncertainParameters, RefusesPriorsThatAreNotPhysical) {
  const auto refusal = [](const ParameterPrior& prior) {
    ParameterPriors priors = default_priors();
    priors[4] = prior;
    return error_of([&] { draw_parameters(priors, 2, 1); });
  };
  EXPECT_EQ(refusal({1, -0.1, 0.5, 2}), "prior: sigma of sand_supply is -0.1, must be 0 to 2");
  EXPECT_EQ(refusal({3, 0.1, 0.5, 2}), "prior: median of sand_supply is 3, must be within the bounds");
  EXPECT_EQ(refusal({1, 0.1, 0, 2}), "prior: lower bound of sand_supply is 0, must be positive and finite");
  EXPECT_EQ(refusal({1, 0.1, 0.5, 0.4}),
            "prior: upper bound of sand_supply is 0.4, must be finite and not below the lower");
  EXPECT_NE(refusal({NAN, 0.1, 0.5, 2}), "no error was thrown");
}

}  // namespace
}  // namespace aeolian
