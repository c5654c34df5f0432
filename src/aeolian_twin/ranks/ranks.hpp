#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace aeolian {

/// The processes that `mpirun` started to share some work, or this one alone when it was started without.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  std::size_t rank() const { return rank_; }
  std::size_t count() const { return count_; }

  /// The texts of all, by rank, for rank 0; nothing for the others. All must call it.
  std::vector<std::string> gather(const std::string& text) const;
  /// The texts of all, by rank, for everyone. All must call it.
  std::vector<std::string> share(const std::string& text) const;

 private:
  bool together_;
  std::size_t rank_ = 0;
  std::size_t count_ = 1;
};

}  // namespace aeolian
