#pragma once

#include <cstdlib>
#include <string>

#include "../temporary_folder.hpp"
#include <sys/wait.h>

namespace aeolian {

struct Outcome {
  int code;  ///< exit code; -1 when a signal ended the program
  std::string out;
  std::string err;
};

/// Runs one of our programs to its end, from a folder when one is given.
inline Outcome run_program(const std::string& name_and_arguments, const std::string& folder = ".") {
  const TemporaryFolder console;
  const std::string command = "cd '" + folder + "' && " AEOLIAN_BIN "/" + name_and_arguments + " > " +
                              console.file("out") + " 2> " + console.file("err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(console.file("out")),
          content_of(console.file("err"))};
}

}  // namespace aeolian
