#include "aeolian_twin/replay/twin_bag.hpp"

namespace aeolian {
namespace {

constexpr std::size_t most_waiting = 64;

}  // namespace

TwinBag::TwinBag(rosbag::Bag& bag) : bag_(bag), waiting_(most_waiting), writer_([this] { work(); }) {}

TwinBag::~TwinBag() {
  if (!writer_.joinable()) return;
  waiting_.close();
  writer_.join();
}

void TwinBag::finish() {
  waiting_.close();
  writer_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void TwinBag::work() {
  while (const auto write = waiting_.pop()) {
    if (failure_) continue;
    try {
      (*write)();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
}

}  // namespace aeolian
