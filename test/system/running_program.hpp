#pragma once

#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace aeolian {

/// One of our programs, running beside the test until this goes out of scope.
class RunningProgram {
 public:
  RunningProgram(const std::string& name, std::vector<std::string> arguments) : pid_(fork()) {
    if (pid_ != 0) return;
    const std::string path = std::string(AEOLIAN_BIN) + "/" + name;
    std::vector<char*> argv{const_cast<char*>(path.c_str())};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(path.c_str(), argv.data());
    _exit(127);
  }
  ~RunningProgram() {
    if (killed_) return;
    EXPECT_TRUE(lives());
    kill(pid_, SIGINT);
    waitpid(pid_, nullptr, 0);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Without a chance to tidy up.
  void kill_now() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    killed_ = true;
  }
  bool lives() const { return waitpid(pid_, nullptr, WNOHANG) == 0; }

 private:
  pid_t pid_;
  bool killed_ = false;
};

}  // namespace aeolian
