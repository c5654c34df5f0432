#include <algorithm>
#include <map>

#include "../rendering/unmeasurable.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using Words = std::vector<std::string>;

/// What a refusal may say for each reason: one of these.
const std::map<std::string, Words> words_for = {
    {"shadow", {"shadow", "border"}},
    {"two", {"two", "either side", "more than one", "shadow"}},
    {"exposed", {"exposed", "white", "dark", "as bright", "contrast", "none of the"}},
    {"contrast", {"contrast", "as bright", "no shadow", "none of the"}},
    {"frame", {"outside the photo", "ends beside", "none of the", "no shadow"}},
    {"blur", {"blurred", "none of the", "no shadow"}},
};

TEST(ShadowRefusals, FiftyPhotographsAreRefusedWithTheReason) {
  const auto scenes = unmeasurable_set_ups();
  ASSERT_GE(scenes.size(), 50u);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SCOPED_TRACE("no. " + std::to_string(i + 1) + ": " + scenes[i].name);
    try {
      measure_shadow(scenes[i].photo(), scenes[i].set_up.setup, ProfileMode::full);
      ADD_FAILURE() << "a profile came out";
    } catch (const Error& error) {
      const std::string said = error.what();
      const Words& words = words_for.at(scenes[i].reason);
      EXPECT_TRUE(std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return said.find(word) != std::string::npos;
      })) << said;
      EXPECT_EQ(said.find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace aeolian
