#pragma once

#include <memory>
#include <string>
#include <vector>

#include "aeolian_rviz/off_screen.hpp"
#include <gtest/gtest.h>

namespace aeolian {

/// rviz on a screen of its own, for all tests of a suite.
class RvizOffScreen : public testing::Test {
 protected:
  /// Leaves all as it is where a program for it is missing: the tests are then skipped.
  static void open_rviz(int width, int height, const std::vector<std::string>& arguments) {
    if (!is_installed("Xvfb") || !is_installed("import") || !is_installed("rviz")) return;
    screen_ = std::make_unique<OffScreen>(width, height);
    if (!screen_->works()) return;
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    std::vector<std::string> command{AEOLIAN_DEVEL "/env.sh", "rviz"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    rviz_ = std::make_unique<ChildProcess>(command, SIGTERM);
  }
  static void TearDownTestSuite() {
    rviz_.reset();
    screen_.reset();
  }

  void SetUp() override {
    if (!rviz_) GTEST_SKIP() << "needs Xvfb, import (ImageMagick) and rviz";
  }
  void TearDown() override {
    if (rviz_) {
      EXPECT_TRUE(rviz_->lives());
    }
  }

 private:
  static inline std::unique_ptr<OffScreen> screen_;
  static inline std::unique_ptr<ChildProcess> rviz_;
};

}  // namespace aeolian
