#pragma once

#include <cstdlib>
#include <filesystem>

namespace aeolian {

/// The folder of real scans, which are not part of the project; it need not be there.
inline std::filesystem::path shared_data() {
  const char* given = std::getenv("AEOLIAN_SHARED_DATA");
  return given != nullptr ? std::filesystem::path(given)
                          : std::filesystem::path(AEOLIAN_REPOSITORY) / "../shared/data";
}

}  // namespace aeolian
