#include "aeolian_twin/nodes/message_pool.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

using Bytes = std::vector<unsigned char>;

TEST(MessagePool, HandsTheMemoryOfAMessageOnOnceNobodyHoldsIt) {
  const MessagePool<Bytes> pool;
  boost::shared_ptr<Bytes> message = pool();
  message->resize(1000);
  const unsigned char* const memory = message->data();
  const boost::shared_ptr<const Bytes> held = message;
  message.reset();
  EXPECT_TRUE(pool()->empty()) << "somebody holds the first";
  EXPECT_EQ(held->data(), memory);
}

TEST(MessagePool, ReusesWhatItsCopiesMade) {
  const MessagePool<Bytes> pool;
  const MessagePool<Bytes> copy = pool;
  boost::shared_ptr<Bytes> message = copy();
  message->resize(1000);
  const unsigned char* const memory = message->data();
  message.reset();
  EXPECT_EQ(pool()->data(), memory);
}

TEST(MessagePool, KeepsNoMoreThanTwo) {
  const MessagePool<Bytes> pool;
  {
    std::vector<boost::shared_ptr<Bytes>> many;
    for (int i = 0; i < 5; ++i) {
      many.push_back(pool());
      many.back()->resize(1000);
    }
  }
  int used = 0;
  std::vector<boost::shared_ptr<Bytes>> many;
  for (int i = 0; i < 5; ++i) {
    many.push_back(pool());
    used += many.back()->empty() ? 0 : 1;
  }
  EXPECT_EQ(used, 2);
}

TEST(MessagePool, MessagesOutliveIt) {
  boost::shared_ptr<Bytes> message;
  {
    const MessagePool<Bytes> pool;
    message = pool();
    message->resize(1000);
  }
  EXPECT_EQ(message->size(), 1000U);
}

}  // namespace
}  // namespace aeolian
