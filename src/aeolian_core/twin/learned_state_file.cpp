#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/yaml_section.hpp"
#include "aeolian_core/twin/parameter_learner.hpp"

namespace aeolian {
namespace {

constexpr int version = 1;

}  // namespace

void ParameterLearner::save(const std::string& path) const {
  std::string text = fmt::format(
      "# What the twin has learned of its parameters, as factors on what is given.\n"
      "version: {}\nupdates: {}\nmembers:  # {}\n",
      version, state_.updates, fmt::join(UncertainParameters::names(), ", "));
  for (const UncertainParameters& member : state_.members)
    text += fmt::format("  - [{}]\n", fmt::join(member.values(), ", "));
  write_text_atomically(path, text);
}

void ParameterLearner::load(const std::string& path) {
  YamlSection file = YamlSection::load(path);
  if (file.integer("version", 0, 1000000) != version)
    file.refuse("version", fmt::format("must be {}", version));
  LearnedState state;
  state.updates = static_cast<std::size_t>(file.integer("updates", 0, 1000000000));
  constexpr std::size_t count = UncertainParameters::count;
  const std::vector<std::vector<double>> rows = file.rows("members", count, count);
  file.finish();
  if (rows.size() != settings_.members)
    throw Error(fmt::format("{}: {} members, must be {} as set", path, rows.size(), settings_.members));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::array<double, count> values{};
    for (std::size_t j = 0; j < count; ++j) {
      values[j] = rows[i][j];
      const ParameterPrior& prior = settings_.priors[j];
      if (!(values[j] >= prior.low && values[j] <= prior.high))
        file.refuse_element("members", i,
                            fmt::format("{} is {:g}, must be from {:g} to {:g}",
                                        UncertainParameters::names()[j], values[j], prior.low, prior.high));
    }
    state.members.push_back(UncertainParameters::from(values));
  }
  state_ = std::move(state);
}

}  // namespace aeolian
