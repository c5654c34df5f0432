#include "aeolian_twin/replay/twin_bag.hpp"

namespace aeolian {
namespace {

constexpr std::ptrdiff_t most_waiting = 64;

}  // namespace

TwinBag::TwinBag(rosbag::Bag& bag) : bag_(bag) {
  waiting_.set_capacity(most_waiting);
  writer_ = std::thread([this] { work(); });
}

TwinBag::~TwinBag() {
  if (!writer_.joinable()) return;
  waiting_.push(nullptr);
  writer_.join();
}

void TwinBag::finish() {
  waiting_.push(nullptr);
  writer_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void TwinBag::work() {
  while (true) {
    std::function<void()> write;
    waiting_.pop(write);
    if (!write) return;
    if (failure_) continue;
    try {
      write();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
}

}  // namespace aeolian
