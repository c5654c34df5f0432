#pragma once

#include <cstdio>
#include <exception>
#include <string>

namespace aeolian {

/// The body of a main() that draws figures into the folder that it is given; `draw(folder)` does. Among all
/// benchmarks, without a folder, there is nothing to do. What goes wrong is told in one line.
template <class Draw>
int draw_figures(const char* name, int argc, char** argv, const Draw& draw) {
  if (argc < 2) return 0;
  try {
    draw(std::string(argv[1]));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace aeolian
