#include "aeolian_core/bedforms/height_map/frame_field.hpp"

#include <algorithm>
#include <mutex>
#include <new>

#include <sys/mman.h>

namespace aeolian {
namespace {

constexpr std::size_t page = std::size_t{1} << 21;
constexpr std::size_t most_kept = std::size_t{1} << 28;  ///< [bytes]
constexpr std::size_t most_spare = 4;                    ///< times what is asked for

bool is_large(std::size_t bytes) { return bytes >= page / 2; }
std::size_t whole_pages(std::size_t bytes) { return (bytes + page - 1) / page * page; }

/// Blocks that were given back, and the sizes of those that are in use: parts of a grid take turns in them.
class Store {
 public:
  /// The smallest that holds so much and not many times as much; null if there is none.
  void* take(std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto best = kept_.end();
    for (auto block = kept_.begin(); block != kept_.end(); ++block)
      if (block->bytes >= bytes && block->bytes <= most_spare * bytes &&
          (best == kept_.end() || block->bytes < best->bytes))
        best = block;
    if (best == kept_.end()) return nullptr;
    const Block block = *best;
    kept_.erase(best);
    kept_bytes_ -= block.bytes;
    used_.push_back(block);
    return block.memory;
  }
  void add(void* memory, std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    used_.push_back({memory, bytes});
  }
  /// Whether it is kept, or else is to be freed.
  bool give_back(void* memory) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found =
        std::find_if(used_.begin(), used_.end(), [&](const Block& b) { return b.memory == memory; });
    const Block block = *found;
    used_.erase(found);
    if (kept_bytes_ + block.bytes > most_kept) return false;
    kept_.push_back(block);
    kept_bytes_ += block.bytes;
    return true;
  }

 private:
  struct Block {
    void* memory;
    std::size_t bytes;
  };
  std::mutex mutex_;
  std::vector<Block> kept_;
  std::vector<Block> used_;
  std::size_t kept_bytes_ = 0;
};

Store& store() {
  static Store* const one = new Store;  // outlives every field
  return *one;
}

}  // namespace

void* take_pages(std::size_t bytes) {
  if (!is_large(bytes)) return ::operator new (bytes, std::align_val_t{64});
  const std::size_t whole = whole_pages(bytes);
  if (void* const kept = store().take(whole)) return kept;
  void* const memory = ::operator new (whole, std::align_val_t{page});
  madvise(memory, whole, MADV_HUGEPAGE);  // a wish only
  store().add(memory, whole);
  return memory;
}

void give_pages(void* memory, std::size_t bytes) {
  if (!is_large(bytes))
    ::operator delete (memory, std::align_val_t{64});
  else if (!store().give_back(memory))
    ::operator delete (memory, std::align_val_t{page});
}

}  // namespace aeolian
