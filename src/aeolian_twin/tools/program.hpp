#pragma once

#include <cstdio>
#include <exception>
#include <functional>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace aeolian {

/// What every program does around its work: reads the command line, runs `body`, and tells of bad input in
/// one line that starts with the program's name. The result is for main() to return: 0, 1, or what the body
/// gives.
inline int run_program(const char* name, CLI::App& app, int argc, char** argv,
                       const std::function<int()>& body) {
  try {
    app.parse(argc, argv);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // errors are told by ours
    return body();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace aeolian
