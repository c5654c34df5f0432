#pragma once

#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace aeolian {

/// A program in the background, ended with the object.
class ChildProcess {
 public:
  enum class Output { shown, dropped };

  explicit ChildProcess(std::vector<std::string> command, int end_signal = SIGINT,
                        Output output = Output::shown)
      : end_signal_(end_signal), pid_(fork()) {
    if (pid_ != 0) return;
    if (output == Output::dropped) {
      const int nothing = open("/dev/null", O_WRONLY);
      dup2(nothing, STDOUT_FILENO);
      dup2(nothing, STDERR_FILENO);
    }
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() { end(end_signal_); }

  bool lives() const { return pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == 0; }
  void end(int signal) {
    if (pid_ <= 0) return;
    kill(pid_, signal);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  /// Time that it has spent on processors [s].
  double processor_seconds() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    const std::string stat(std::istreambuf_iterator<char>(file), {});
    std::istringstream fields(stat.substr(stat.rfind(')') + 2));  // the name may hold blanks
    const std::vector<std::string> words{std::istream_iterator<std::string>(fields), {}};
    return (std::stod(words[11]) + std::stod(words[12])) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

 private:
  int end_signal_;
  pid_t pid_;
};

}  // namespace aeolian
