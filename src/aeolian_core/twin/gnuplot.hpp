#pragma once

#include <string>

namespace aeolian {

/// Runs gnuplot on a script that draws into an SVG picture of the given size [px], written atomically to
/// `path`. The script gets the terminal and the output set. Throws Error with gnuplot's own complaint, or
/// when it is not installed.
void plot_svg(const std::string& script, int width, int height, const std::string& path);

}  // namespace aeolian
