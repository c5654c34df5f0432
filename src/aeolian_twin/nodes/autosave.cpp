#include "aeolian_twin/nodes/autosave.hpp"

#include <chrono>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

void Autosave::begin(StoredMap stored) {
  running_ = std::async(std::launch::async, [map = std::move(stored), file = file_, topic = topic_] {
    try {
      save_map(map, file, topic);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  });
}

std::optional<std::string> Autosave::finished() {
  const bool done =
      running_.valid() && running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!done) return std::nullopt;
  return running_.get();
}

}  // namespace aeolian
