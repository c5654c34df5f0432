#pragma once

#include <future>
#include <optional>
#include <string>

#include "aeolian_twin/nodes/map_file.hpp"

namespace aeolian {

/// Saves a map now and then on a thread of its own, so that nothing waits for the disk.
class Autosave {
 public:
  /// Destroyed, it waits for a save that is under way.
  Autosave(std::string file, std::string topic) : file_(std::move(file)), topic_(std::move(topic)) {}

  const std::string& file() const { return file_; }
  /// Begins to save; nothing must be under way.
  void begin(StoredMap stored);
  bool under_way() const { return running_.valid(); }
  void wait() {
    if (running_.valid()) running_.get();
  }
  /// Once for each save, when it has finished: the line of its error, empty when there was none.
  std::optional<std::string> finished();

 private:
  std::string file_;
  std::string topic_;
  std::future<std::string> running_;
};

}  // namespace aeolian
