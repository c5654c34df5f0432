#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace aeolian::bench {

/// Without a DISPLAY: begins this program anew on a screen that nobody sees. False when there is none to be
/// had; what is drawn from here on is drawn without a graphics card.
inline bool has_screen(char** argv) {
  if (!std::getenv("DISPLAY")) {
    execlp("xvfb-run", "xvfb-run", "-a", "-s", "-screen 0 1400x900x24 +extension GLX -nolisten tcp", argv[0],
           nullptr);
    std::perror("no DISPLAY and no xvfb-run");
    return false;
  }
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  return true;
}

/// This program once more, with other arguments: what it ended with.
inline int run_self(std::vector<std::string> arguments) {
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> pointers{program_invocation_short_name};
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    execv("/proc/self/exe", pointers.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace aeolian::bench
