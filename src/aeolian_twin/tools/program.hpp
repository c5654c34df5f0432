#pragma once

#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace aeolian {

/// Runs a program's body and tells of bad input in one line that starts with the program's name. The result
/// is for main() to return: what the body gives, or 1.
inline int run_program(const char* name, const std::function<int()>& body) {
  try {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // errors are told by ours
    return body();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

/// Reads the command line. Gives the exit code when there is nothing more to do: 0 after --help, 1 after what
/// cannot be understood.
inline std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
}

/// What was typed, as it is typed anywhere: for files that tell how they were made.
inline std::string typed_command(const char* name, int argc, char** argv) {
  std::string command = std::string("rosrun aeolian_twin ") + name;
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

}  // namespace aeolian
