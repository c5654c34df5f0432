#pragma once

#include <csignal>
#include <string>
#include <vector>

#include "../child_process.hpp"
#include <gtest/gtest.h>

namespace aeolian {

/// One of our programs, running beside the test until this goes out of scope.
class RunningProgram {
 public:
  RunningProgram(const std::string& name, std::vector<std::string> arguments)
      : child_(command(name, std::move(arguments))) {}
  ~RunningProgram() {
    if (!killed_) {
      EXPECT_TRUE(lives());
    }
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Without a chance to tidy up.
  void kill_now() {
    child_.end(SIGKILL);
    killed_ = true;
  }
  bool lives() const { return child_.lives(); }

 private:
  static std::vector<std::string> command(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), std::string(AEOLIAN_BIN) + "/" + name);
    return arguments;
  }

  ChildProcess child_;
  bool killed_ = false;
};

}  // namespace aeolian
