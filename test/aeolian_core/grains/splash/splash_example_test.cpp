#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

// [example]
#include "aeolian_core/grains/grains.hpp"

/// Mean reptation of one impact of fine sand at 2.5 m/s and 12 degrees on a bed that rises by `slope` [rad];
/// [m].
double mean_reptation_on(double slope) {
  aeolian::SplashMaterial material = aeolian::splash_material("fine_sand");
  material.grain.diameter = 0.0003;  // [m]
  const auto splash = aeolian::splash_of("werner", material);

  aeolian::Impact impact{2.5, 12 * M_PI / 180};  // [m/s], [rad]
  impact.slope = slope;

  aeolian::RandomStream random(1, 0);  // seed, stream: one stream for each thread or place
  aeolian::SplashEvent event;          // used again and again
  double sum = 0;
  const int impacts = 20000;
  for (int i = 0; i < impacts; ++i) {
    splash->sample(impact, random, event);
    sum += aeolian::reptation_distance(event, slope);
  }
  return sum / impacts;
}
// [example]

namespace aeolian {
namespace {

TEST(SplashExampleTest, does_what_it_says) {
  EXPECT_GT(mean_reptation_on(0), 0.0005);
  EXPECT_LT(mean_reptation_on(30 * M_PI / 180), mean_reptation_on(0));
}

std::string text_of(const std::string& path) {
  std::ifstream file(std::string(AEOLIAN_REPOSITORY) + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(SplashExampleTest, stands_in_the_documentation) {
  const std::string source = text_of("/test/aeolian_core/grains/splash/splash_example_test.cpp");
  const std::string mark = "// [example]\n";
  const std::size_t from = source.find(mark) + mark.size();
  const std::string example = source.substr(from, source.find(mark, from) - from);
  EXPECT_NE(text_of("/docs/splash.md").find("```cpp\n" + example + "```"), std::string::npos) << example;
}

}  // namespace
}  // namespace aeolian
