#pragma once

#include <filesystem>
#include <string>

#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include <gtest/gtest.h>

namespace aeolian {

/// A program that takes `--config FILE --out DIR`, and a file of it that is good.
struct ConfiguredProgram {
  std::string name, config;

  /// Spoils the good file, as bad.yaml in `folder`, and expects the program to say `line` and to write
  /// nothing.
  void expect_refusal(const TemporaryFolder& folder, const std::string& from, const std::string& to,
                      const std::string& line) const {
    std::string text = config;
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    folder.write("bad.yaml", text.replace(at, from.size(), to));
    const Outcome outcome = run_program(name + " --config bad.yaml --out results", folder.path());
    EXPECT_EQ(outcome.code, 1) << to;
    EXPECT_EQ(outcome.err, name + ": " + line + "\n");
    EXPECT_FALSE(std::filesystem::exists(folder.file("results"))) << to;
  }
};

}  // namespace aeolian
