#include "aeolian_twin/nodes/job_thread.hpp"

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

void wait_until(const std::function<bool()>& holds) {
  while (!holds()) std::this_thread::yield();
}

TEST(JobThread, IsIdleUntilAJobComesAndAfterItsEnd) {
  std::promise<int> result;
  JobThread<int> thread;
  EXPECT_TRUE(thread.idle());
  thread.start([&](const int& job) { result.set_value(job); });
  EXPECT_TRUE(thread.submit(7));
  EXPECT_EQ(result.get_future().get(), 7);
  wait_until([&] { return thread.idle(); });
}

TEST(JobThread, TheNewestJobTakesThePlaceOfTheOneThatWaits) {
  std::vector<int> done;
  std::atomic<int> begun{0}, let_go{0};
  JobThread<int> thread;
  thread.start([&](const int& job) {
    done.push_back(job);
    const int number = ++begun;
    wait_until([&] { return let_go >= number; });
  });
  EXPECT_TRUE(thread.submit(1));
  wait_until([&] { return begun == 1; });
  EXPECT_FALSE(thread.submit(2));
  EXPECT_FALSE(thread.submit(3));
  EXPECT_FALSE(thread.idle());
  let_go = 2;
  wait_until([&] { return thread.idle(); });
  EXPECT_EQ(done, (std::vector<int>{1, 3}));
}

TEST(JobThread, ItsEndWaitsForTheJobUnderWayAndLeavesTheWaitingOne) {
  std::promise<void> begun;
  std::vector<int> done;
  {
    auto thread = std::make_unique<JobThread<int>>();
    thread->start([&, &thread = *thread](const int& job) {
      begun.set_value();
      wait_until([&] { return thread.stopping(); });
      done.push_back(job);
    });
    thread->submit(1);
    begun.get_future().wait();
    thread->submit(2);
  }
  EXPECT_EQ(done, std::vector<int>{1});
}

}  // namespace
}  // namespace aeolian
