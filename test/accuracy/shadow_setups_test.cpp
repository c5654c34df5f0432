#include "../rendering/laboratory.hpp"
#include "../rendering/ripple_bed.hpp"
#include "../rendering/shadow_score.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// The laboratory's ripples, with the marks of one row alone and no heights across.
class OneRowOfMarks : public testing::Test {
 protected:
  OneRowOfMarks() {
    RippleBed bed;
    bed.height = -0.008;
    bed.wavelength = 0.04;
    bed.relief = 0.003;
    Laboratory laboratory;
    laboratory.bed = bed;
    set_up_ = set_up_of(laboratory);
    photo_ = photograph(set_up_.scene);
    std::vector<PhotoSetup::ScaleMark> row;
    for (const auto& mark : set_up_.setup.scale)
      if (*mark.y > -0.01) row.push_back({mark.pixel, mark.x, {}});
    set_up_.setup.scale = row;
    for (const double x : {-0.04, 0.0, 0.04})
      set_up_.setup.line_px.push_back(true_pixel(set_up_.scene, {x, 0, 0}));
  }

  std::string refusal() const {
    try {
      measure_shadow(photo_, set_up_.setup, ProfileMode::full);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  aeolian::SetUp set_up_;
  Photo photo_;
};

TEST_F(OneRowOfMarks, WillDoUnderAPlumbCamera) {
  set_up_.setup.plumb = true;
  const auto result = score(set_up_, measure_shadow(photo_, set_up_.setup, ProfileMode::full));
  EXPECT_LT(result.rmse, result.bar);
}

TEST_F(OneRowOfMarks, AsksForMoreUnderAnyOther) {
  const std::string said = refusal();
  for (const char* word : {"markers", "second row", "plumb"})
    EXPECT_NE(said.find(word), std::string::npos) << said;
}

TEST_F(OneRowOfMarks, AMarkThatDisagreesIsNamed) {
  set_up_.setup.plumb = true;
  set_up_.setup.scale[4].pixel.x() += 15;
  EXPECT_NE(refusal().find("disagree"), std::string::npos);
}

TEST_F(OneRowOfMarks, ACameraOfAnotherSizeIsRefused) {
  set_up_.setup.camera->width_px = 4000;
  EXPECT_NE(refusal().find("4000"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
