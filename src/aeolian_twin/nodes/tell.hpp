#pragma once

#include <functional>
#include <string>

namespace aeolian {

/// Says how a thing ("clouds", "transform", "clock") is, in one line.
using Tell = std::function<void(const std::string& thing, bool well, const std::string& line)>;

}  // namespace aeolian
