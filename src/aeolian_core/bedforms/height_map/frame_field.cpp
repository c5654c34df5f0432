#include "aeolian_core/bedforms/height_map/frame_field.hpp"

#include <algorithm>
#include <mutex>
#include <new>

#include <sys/mman.h>

namespace aeolian {
namespace {

constexpr std::size_t page = std::size_t{1} << 21;
constexpr std::size_t most_kept = std::size_t{1} << 28;  ///< [bytes]

bool is_large(std::size_t bytes) { return bytes >= page / 2; }
std::size_t whole_pages(std::size_t bytes) { return (bytes + page - 1) / page * page; }

/// Blocks that were given back.
class Store {
 public:
  void* take(std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found =
        std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) { return b.bytes == bytes; });
    if (found == blocks_.end()) return nullptr;
    void* const memory = found->memory;
    kept_ -= bytes;
    blocks_.erase(found);
    return memory;
  }
  bool keep(void* memory, std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kept_ + bytes > most_kept) return false;
    blocks_.push_back({memory, bytes});
    kept_ += bytes;
    return true;
  }

 private:
  struct Block {
    void* memory;
    std::size_t bytes;
  };
  std::mutex mutex_;
  std::vector<Block> blocks_;
  std::size_t kept_ = 0;
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
  return memory;
}

void give_pages(void* memory, std::size_t bytes) {
  if (!is_large(bytes))
    ::operator delete (memory, std::align_val_t{64});
  else if (!store().keep(memory, whole_pages(bytes)))
    ::operator delete (memory, std::align_val_t{page});
}

}  // namespace aeolian
