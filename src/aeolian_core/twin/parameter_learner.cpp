#include "aeolian_core/twin/parameter_learner.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

ParameterLearner::ParameterLearner(const Settings& settings) : settings_(settings) {
  state_.members = draw_parameters(settings.priors, settings.members, settings.seed);
}

/// The middle of the members' logarithms, parameter by parameter.
UncertainParameters ParameterLearner::median() const {
  std::array<double, UncertainParameters::count> result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    double sum = 0;
    for (const UncertainParameters& member : state_.members) sum += std::log(member.values()[i]);
    result[i] = std::exp(sum / static_cast<double>(state_.members.size()));
  }
  return UncertainParameters::from(result);
}

ParameterLearner::Update ParameterLearner::learn(const EnsembleForecast& /*predicted*/,
                                                 std::size_t /*horizon*/, const HeightMap& /*measured*/) {
  Update update;
  update.why_not = "misses are only watched";
  update.before = update.after = median();
  return update;
}

void ParameterLearner::save(const std::string& path) const {
  throw Error("learned parameters: cannot be written to " + path + " yet");
}

void ParameterLearner::load(const std::string& path) {
  throw Error("learned parameters: cannot be read from " + path + " yet");
}

}  // namespace aeolian
