#pragma once

#include <string>

namespace aeolian {

/// "now" for 0, "30 s", "5 min", "2 min 30 s", "1 h 30 min"; to the second, or the minute from an hour on.
std::string lead_time_words(double seconds);

}  // namespace aeolian
